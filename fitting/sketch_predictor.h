#pragma once
#include "geometry/mesh.h"
#include "models/sketch_run.h"
#include "render/drawing.h"

#include <torch/types.h>

#include <filesystem>
#include <vector>

namespace daumier::fitting {

/// Strokes of the canvas as the network sees them, drawn with the pen of the training sketches: (1, 1, R, R) float32,
/// ink 1, paper 0.
torch::Tensor SketchTensor(const std::vector<render::Stroke>& strokes, int resolution);

/// Where a drawing stands on the canvas.
enum class Framing {
  kFit,   ///< Its bounding box is brought to where the training's heads stand (render::FrameStrokes).
  kKeep,  ///< The sheet is the canvas: for drawings that were made in the training's frame.
};
/// @throws Error as render::FrameStrokes.
std::vector<render::Stroke> OnCanvas(const render::Drawing& drawing, Framing framing);

/// A trained run, ready to turn drawings into faces.
class SketchPredictor {
 public:
  /// @throws Error as models::LoadSketchRun.
  explicit SketchPredictor(const std::filesystem::path& run_directory);

  /// sketch: (1, 1, R, R). V x 3, in cm.
  geometry::Points Predict(const torch::Tensor& sketch);

  int resolution() const { return run_.network->options().resolution; }
  const models::SketchRun& run() const { return run_; }

 private:
  models::SketchRun run_;
};

/// `daumier predict`: for every drawing of the files (render::ReadDrawings) a mesh NAME.obj, the strokes as the network
/// sees them NAME.svg, a sheet NAME.png of sketch, front and side, and a manifest (kind "predictions"). NAME is the
/// file's; drawings of the same name are told apart by -2, -3, ... Nothing is written unless every file can be read.
/// @throws Error as SketchPredictor, render::ReadDrawings and OnCanvas, naming the file.
void PredictSketches(const std::filesystem::path& run_directory, const std::vector<std::filesystem::path>& files,
                     const std::filesystem::path& out_directory, Framing framing = Framing::kFit);

}  // namespace daumier::fitting
