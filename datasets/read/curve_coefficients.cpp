#include "datasets/read/curve_coefficients.h"

namespace daumier::datasets {

std::vector<float> PointWeights(const SketchDatabase& sketches, const std::vector<render::Stroke>& strokes,
                                const std::vector<std::vector<bool>>& visible) {
  std::vector<float> weights;
  for (const int curve : sketches.feature_curves()) {
    for (size_t point = 0; point < strokes[size_t(curve)].points.size(); ++point)
      weights.push_back(visible.empty() || visible[size_t(curve)][point] ? 1.0f : 0.0f);
  }
  return weights;
}

faces::CurveCode GivenShape(const faces::CurveEncoder& encoder, const SketchDatabase& sketches,
                            const std::vector<render::Stroke>& strokes, const std::vector<std::vector<bool>>& visible) {
  return encoder.Encode(PointsOf(strokes, sketches.feature_curves()), PointWeights(sketches, strokes, visible));
}

}  // namespace daumier::datasets
