#include "fitting/curve_pull.h"

#include <algorithm>

namespace daumier::fitting {

using Eigen::Vector2f;

bool CurvePull::any() const {
  return std::any_of(weights.begin(), weights.end(), [](float weight) { return weight > 0; });
}

CurvePull PullOf(const SegmentGrid& strokes, const CurveOffsets& offsets, const Eigen::VectorXf& curves, float reach,
                 float least_cosine) {
  CurvePull pull{{curves.data(), curves.data() + curves.size()}, std::vector<float>(size_t(offsets.back()), 0.0f)};
  for (size_t curve = 0; curve + 1 < offsets.size(); ++curve) {
    const int first = offsets[curve], last = offsets[curve + 1] - 1;
    for (int k = first; k <= last; ++k) {
      const Vector2f point = curves.segment<2>(2 * k);
      const Vector2f direction =
          Unit(curves.segment<2>(2 * std::min(k + 1, last)) - curves.segment<2>(2 * std::max(k - 1, first)));
      const auto snapped = strokes.Nearest(point, direction, reach, least_cosine);
      if (!snapped) continue;
      const float share = (*snapped - point).squaredNorm() / (reach * reach);
      pull.weights[size_t(k)] = (1 - share) * (1 - share);
      pull.points[2 * size_t(k)] = snapped->x(), pull.points[2 * size_t(k) + 1] = snapped->y();
    }
  }
  return pull;
}

}  // namespace daumier::fitting
