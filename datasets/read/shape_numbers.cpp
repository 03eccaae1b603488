#include "datasets/read/shape_numbers.h"

namespace daumier::datasets {

faces::CurveCode GivenShape(const faces::CurveEncoder& encoder, const SketchDatabase& sketches,
                            const std::vector<render::Stroke>& strokes, const std::vector<std::vector<bool>>& visible) {
  const std::vector<float> points = PointsOf(strokes, sketches.feature_curves());
  std::vector<float> weights;
  weights.reserve(points.size() / 2);
  for (const int curve : sketches.feature_curves()) {
    for (size_t point = 0; point < strokes[size_t(curve)].points.size(); ++point)
      weights.push_back(visible.empty() || visible[size_t(curve)][point] ? 1.0f : 0.0f);
  }
  return encoder.Encode(points, weights);
}

}  // namespace daumier::datasets
