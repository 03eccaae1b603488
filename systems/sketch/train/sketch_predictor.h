#pragma once
#include "fitting/contour_refinement.h"
#include "fitting/projected_curves.h"
#include "systems/sketch/train/run.h"
#include "render/strokes.h"

#include <torch/types.h>

#include <filesystem>
#include <vector>

namespace daumier::sketch {

/// Strokes of the canvas as the network sees them, drawn with the pen of the training sketches: (1, 1, R, R) float32,
/// ink 1, paper 0.
torch::Tensor SketchTensor(const std::vector<render::Stroke>& strokes, int resolution);

/// A trained run, ready to turn drawings into faces. A network that reads shape-level numbers gets those of the mean
/// face first; then they are recovered from the strokes twice (fitting::RecoverCurves), from the face that it predicts.
class SketchPredictor {
 public:
  /// @throws Error as LoadSketchRun and fitting::SeeCurves.
  explicit SketchPredictor(const std::filesystem::path& run_directory);

  /// One face a sketch, whose strokes are on the canvas. @throws Error if a network that reads points is given a sketch
  /// without any length.
  std::vector<fitting::PredictedFace> Predict(const std::vector<std::vector<render::Stroke>>& sketches);
  /// The feature curves of a face as the camera of the training sketches sees them, on the canvas.
  std::vector<render::Stroke> CurvesOf(const fitting::PredictedFace& face) const;

  const SketchRun& run() const { return run_; }
  const fitting::ProjectedCurves& curves() const { return curves_; }

 private:
  std::vector<fitting::PredictedFace> Answer(const SketchInput& input);

  SketchRun run_;
  fitting::ProjectedCurves curves_;
};

}  // namespace daumier::sketch
