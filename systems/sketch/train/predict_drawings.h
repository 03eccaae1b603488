#pragma once
#include "fitting/contour_refinement.h"
#include "fitting/frame_search.h"
#include "fitting/stroke_deformation.h"
#include "render/drawing.h"
#include "render/framing.h"

#include <filesystem>
#include <vector>

namespace daumier::sketch {

/// Where a drawing stands on the canvas.
enum class Framing {
  kFit,   ///< Where the predicted face is nearest to it (fitting::FindFrame).
  kKeep,  ///< The sheet is the canvas: for drawings that were made in the training's frame.
};
/// The sheet as the whole canvas, its longer side; the shorter one gets paper on both sides.
render::Placement SheetPlacement(const render::Drawing& drawing);

struct PredictOptions {
  Framing framing = Framing::kFit;
  bool refine = true;   ///< Whether contours are matched after the network (fitting::ContourRefiner).
  bool deform = false;  ///< Whether the surface is moved onto the strokes after that (fitting::StrokeDeformer).
  fitting::FrameSearchOptions search = {};
  fitting::ContourRefinementOptions refinement = {};
  fitting::StrokeDeformationOptions deformation = {};
};

/// `daumier predict`: for every drawing of the files (render::ReadDrawings) a mesh NAME.obj, the strokes as the network
/// sees them NAME.svg, a sheet NAME.png of sketch with the face's curves, front and side, and a manifest (kind
/// "predictions"). NAME is the file's; drawings of the same name are told apart by -2, -3, ... details.drawings.NAME
/// holds the frame (p_canvas = scale * p_sheet + shift) and the two-way distance between the drawing and the face's
/// curves in pixels of the canvas: of the first frame ("before"), of the frame taken ("framed") and of the mesh that is
/// written ("after"), each plain, and "after" also trimmed as fitting::FrameSearchOptions tell.
/// Nothing is written unless every file can be read and every drawing predicted.
/// @throws Error as SketchPredictor, render::ReadDrawings, render::FrameDrawing and fitting::DistanceBetween, naming the file.
void PredictSketches(const std::filesystem::path& run_directory, const std::vector<std::filesystem::path>& files,
                     const std::filesystem::path& out_directory, const PredictOptions& options = {});

}  // namespace daumier::sketch
