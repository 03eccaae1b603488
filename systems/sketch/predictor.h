#pragma once
#include "core/device.h"
#include "core/options.h"
#include "fitting/contour_refinement.h"
#include "fitting/frame_search.h"
#include "fitting/stroke_deformation.h"
#include "systems/predictor.h"
#include "systems/sketch/stroke_network.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace daumier::sketch {

struct PredictOptions {
  std::string framing = "fit";
  std::string faces = "largest";
  bool refine = true;
  bool deform = false;
  fitting::FrameSearchOptions search = {};
  fitting::ContourRefinementOptions refinement = {};
  fitting::StrokeDeformationOptions deformation = {};

  template <class V>
  void Visit(V&& visit) {
    visit("framing", framing, Choices{{"fit", "keep"}},
          "Scale and shift of a drawing on the canvas: fit to the predicted face, or the sheet is the canvas, for "
          "drawings that were made in the frame of the training sketches.");
    visit(
        "faces", faces, Choices{{"largest", "all"}},
        "Of several faces on one sheet: predict the largest, or all of them. A sheet that is the canvas is one face.");
    visit("refine", refine, Flag{}, "Match the contours of the predicted face with the strokes.");
    visit("deform", deform, Flag{}, "Then move the surface onto the strokes, beyond the model of faces.");
    visit("search", search, Table{}, "How the frame is found.");
    visit("refinement", refinement, Table{}, "How contours are matched.");
    visit("deformation", deformation, Table{}, "How the surface is moved.");
  }
};

/// The sheet as the whole canvas, its longer side; the shorter one gets paper on both sides.
render::Placement SheetPlacement(const render::Drawing& drawing);

/// A face whose lines are farther from the drawn ones, two-way in pixels of the canvas and before any deformation, fits
/// the drawing badly. Measured on a network of the demo: 12 careful drawings by hand 2.4 to 7.5, sketches of its own data
/// 0.2 to 7.2 even at twice the strength of augmentation, 12 scrawled faces of Quick, Draw! 5.3 to 11; 21 of 30 drawings
/// of other things (letters, animals, shapes) 8.05 to 26. The other nine, 4.8 to 7.7, are as near as faces, for their
/// lines are many: spiral, waves, grid, lines, zigzag, scribble, tree, house, the face of a cat.
inline constexpr double kBadFitPx = 8;

/// The chain of a sketch run, the only one, from a drawing to a face:
///   network (StrokeNetwork, which recovers curve coefficients) -> fitting::ContourRefiner -> fitting::StrokeDeformer.
class SketchPredictor : public systems::Predictor {
 public:
  /// @throws Error as StrokeNetwork and the fitters.
  SketchPredictor(SketchRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                  const PredictOptions& options = {});

  /// Several faces on one sheet are predicted with faces=all, and else the largest, with a warning (FacesOnSheet).
  std::vector<systems::Input> Separate(systems::Input input) const override;
  /// Drawings, and images of line drawings (render::TraceLineDrawing). record holds the frame and the two-way distance
  /// between drawing and curves in pixels of the canvas: of the first frame ("before"), of the frame taken ("framed"),
  /// of the result ("after"), and that trimmed as FrameSearchOptions specify ("after_trimmed"). A warning says if a face
  /// fits badly (kBadFitPx), with the figure: the drawing is no face, or with framing=keep in another frame.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

  /// The three stages on strokes that are on the canvas. `strokes` of the last two: without labels. Deformed throws
  /// Error if the options disable it.
  std::vector<fitting::PredictedFace> FromStrokes(const std::vector<std::vector<render::Stroke>>& sketches) const {
    return network_.Predict(sketches);
  }
  fitting::PredictedFace Refined(const fitting::PredictedFace& face, const std::vector<render::Stroke>& strokes) const;
  fitting::PredictedFace Deformed(fitting::PredictedFace face, const std::vector<render::Stroke>& strokes) const;
  /// The feature curves of a face on the canvas.
  std::vector<render::Stroke> CurvesOf(const fitting::PredictedFace& face) const { return network_.CurvesOf(face); }

  const SketchRunFolder& run() const { return run_; }
  const fitting::ProjectedCurves& curves() const { return network_.curves(); }
  const PredictOptions& options() const { return options_; }

 private:
  /// The mean of the faces of a drawing in several frames whose weights' sum is 1; of u, v and vertices each.
  fitting::PredictedFace MeanFace(const std::vector<render::Stroke>& strokes,
                                  std::span<const fitting::WeightedFrame> frames) const;
  systems::FaceResult PredictOne(const render::Drawing& sheet, const Task& task) const;

  SketchRunFolder run_;
  PredictOptions options_;
  std::shared_ptr<const faces::FaceTemplate> face_template_;
  StrokeNetwork network_;
  fitting::ContourRefiner refiner_;
  std::optional<fitting::StrokeDeformer> deformer_;
};

/// The predictor of a run folder, with its network from the training library.
/// @throws Error as ReadSketchRunFolder and systems::LoadTrainingLibrary.
std::unique_ptr<systems::Predictor> OpenSketchPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options = Json::object());

}  // namespace daumier::sketch
