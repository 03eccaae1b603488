#pragma once
#include "fitting/contour_refinement.h"
#include "fitting/projected_curves.h"
#include "render/strokes.h"
#include "runtime/network_runner.h"
#include "systems/sketch/run_folder.h"

#include <memory>
#include <vector>

namespace daumier::sketch {

/// Strokes of the canvas as an image network reads them, drawn with the pen of the training sketches: R x R, ink 1,
/// paper 0.
std::vector<float> InkOf(const std::vector<render::Stroke>& strokes, int resolution);

/// The network of a run, from strokes on the canvas to faces. A network that reads curve coefficients gets those of the
/// mean face first; then they are recovered from the strokes twice (fitting::RecoverCurves), from the face that it
/// predicts.
class StrokeNetwork {
 public:
  /// The run has to outlive it. @throws Error as fitting::SeeCurves.
  StrokeNetwork(const SketchRunFolder& run, std::shared_ptr<const runtime::NetworkRunner> network);

  /// One face a sketch. May be called from several threads. @throws Error if a network that reads points is given a
  /// sketch without any length.
  std::vector<fitting::PredictedFace> Predict(const std::vector<std::vector<render::Stroke>>& sketches) const;
  /// The feature curves of a face projected by the camera of the training sketches, on the canvas.
  std::vector<render::Stroke> CurvesOf(const fitting::PredictedFace& face) const;

  const fitting::ProjectedCurves& curves() const { return curves_; }

 private:
  std::vector<fitting::PredictedFace> Forward(const NamedArrays& input) const;

  const SketchRunFolder& run_;
  std::shared_ptr<const runtime::NetworkRunner> network_;
  fitting::ProjectedCurves curves_;
};

}  // namespace daumier::sketch
