#pragma once
#include "geometry/mesh.h"
#include "models/sketch_run.h"
#include "render/image.h"

#include <torch/types.h>

#include <filesystem>
#include <vector>

namespace daumier::fitting {

/// A picture of a drawing as the network sees it: (1, 1, R, R) float32, ink 1, paper 0. The paper is the picture's
/// median grey; light lines on dark are inverted. The picture is padded to a square with paper and scaled to R x R by
/// the mean over areas; what differs from the paper by less than the grain of paper counts as paper, and faint lines
/// are strengthened until the inkiest fiftieth of the picture is as dark as in training.
/// @throws Error if the picture is empty or holds no lines.
torch::Tensor SketchFromImage(const render::Image& image, int resolution);

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

/// `daumier predict`: for every picture NAME.* a mesh NAME.obj and a sheet NAME.png of sketch, front and side, and a
/// manifest (kind "predictions"). Pictures of the same name are told apart by -2, -3, ... Nothing is written unless
/// every picture can be read.
/// @throws Error as SketchPredictor, render::ReadImage and SketchFromImage, naming the picture.
void PredictSketches(const std::filesystem::path& run_directory, const std::vector<std::filesystem::path>& pictures,
                     const std::filesystem::path& out_directory);

}  // namespace daumier::fitting
