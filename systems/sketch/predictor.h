#pragma once
#include "core/device.h"
#include "core/options.h"
#include "fitting/contour_refinement.h"
#include "systems/predictor.h"
#include "systems/sketch/drawing_fitter.h"
#include "systems/sketch/stroke_network.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::sketch {

struct PredictOptions {
  std::string framing = "fit";
  std::string faces = "largest";
  bool fit = true;
  bool refine = true;
  std::string parser = {};
  DrawingParserOptions parsing = {};
  DrawingFitOptions fitting = {};
  fitting::ContourRefinementOptions refinement = {};

  template <class V>
  void Visit(V&& visit) {
    visit("framing", framing, Choices{{"fit", "keep"}},
          "fit: a parser of drawings finds the face; keep: the sheet is the canvas, for drawings that were made in the "
          "frame of the training sketches.");
    visit(
        "faces", faces, Choices{{"largest", "all"}},
        "Of several faces on one sheet: predict the largest, or all of them. A sheet that is the canvas is one face.");
    visit(
        "fit", fit, Flag{},
        "Fit the face to the parsed drawing, from the network's face; false: the network's face alone. Not of a sheet "
        "that is the canvas.");
    visit("refine", refine, Flag{},
          "Match the contours of the predicted face with the strokes, of a sheet that is the canvas.");
    visit("parser", parser, Text{},
          "Folder of a run or of weights of the task drawing_parser, or the name of shipped weights. Empty: those "
          "in the shipped weights.");
    visit("parsing", parsing, Table{}, "How drawings are parsed.");
    visit("fitting", fitting, Table{}, "How faces are fitted.");
    visit("refinement", refinement, Table{}, "How contours are matched.");
  }
};

/// The sheet as the whole canvas, its longer side; the shorter one gets paper on both sides.
render::Placement SheetPlacement(const render::Drawing& drawing);

/// The chain of a sketch run, the only one, from a drawing to a face:
///   DrawingParser -> frame of its points -> StrokeNetwork on the lines of the face -> DrawingFitter,
/// or, of a sheet that is the canvas, StrokeNetwork -> fitting::ContourRefiner.
class SketchPredictor : public systems::Predictor {
 public:
  /// parser: null if sheets are canvases. @throws Error as StrokeNetwork and the fitters, or if a drawing is to be framed
  /// and the parser, or the normal distribution of the run's faces, is missing.
  SketchPredictor(SketchRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                  std::shared_ptr<const DrawingParser> parser, const PredictOptions& options = {});

  /// Several faces on one sheet are predicted with faces=all, and else the largest, with a warning (FacesOnSheet).
  std::vector<systems::Input> Separate(systems::Input input) const override;
  std::shared_ptr<const faces::FaceTemplate> face_template() const override { return face_template_; }
  /// Drawings, and images of line drawings (render::TraceLineDrawing). record holds the frame; of a parsed drawing states
  /// and view, the turn of the head and how well the face fits. @throws Error if the drawing shows a profile.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

  /// Faces of strokes that are on the canvas, and contours matched with strokes without labels. Refined throws Error
  /// unless sheets are canvases and contours are matched.
  std::vector<fitting::PredictedFace> FromStrokes(const std::vector<std::vector<render::Stroke>>& sketches) const {
    return network_.Predict(sketches);
  }
  fitting::PredictedFace Refined(const fitting::PredictedFace& face, const std::vector<render::Stroke>& strokes) const;
  /// The feature curves of a face on the canvas.
  std::vector<render::Stroke> CurvesOf(const fitting::PredictedFace& face) const { return network_.CurvesOf(face); }

  const SketchRunFolder& run() const { return run_; }
  const fitting::ProjectedCurves& curves() const { return network_.curves(); }
  const PredictOptions& options() const { return options_; }

 private:
  /// A face, where it is on its canvas, and what to say of it.
  struct Found {
    fitting::PredictedFace face;
    render::Placement placement;  ///< Sheet to canvas.
    std::vector<std::string> warnings;
    Json record = Json::object();
  };
  systems::FaceResult PredictOne(const render::Drawing& sheet, const Task& task) const;
  Found OfCanvas(const std::vector<render::Stroke>& strokes, const render::Placement& placement) const;
  Found OfParsed(const std::vector<render::Stroke>& strokes, const Task& task) const;
  void FitTo(const ParsedDrawing& parsed, Found& found) const;

  SketchRunFolder run_;
  PredictOptions options_;
  std::shared_ptr<const faces::FaceTemplate> face_template_;
  StrokeNetwork network_;
  std::optional<fitting::ContourRefiner> refiner_;  ///< Of sheets that are canvases.
  std::optional<DrawingFitter> fitter_;             ///< Where drawings are framed.
};

/// The predictor of a run folder, with its network from the training library.
/// @throws UsageError, before anything is loaded, if there is no parser (ParserFolder), or contours are to be matched by
/// shipped weights; Error as ReadSketchFolder and systems::LoadTrainingLibrary.
std::unique_ptr<systems::Predictor> OpenSketchPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options = Json::object());

}  // namespace daumier::sketch
