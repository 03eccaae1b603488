#include "fitting/curve_recovery.h"

#include "core/error.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

/// A straight piece of a drawn stroke.
struct Segment {
  Vector2f from, to, direction;

  Vector2f Nearest(const Vector2f& point) const {
    const Vector2f along = to - from;
    const float length2 = along.squaredNorm();
    const float share = length2 > 0 ? std::clamp((point - from).dot(along) / length2, 0.0f, 1.0f) : 0.0f;
    return from + share * along;
  }
};

Vector2f Unit(const Vector2f& vector) {
  const float length = vector.norm();
  return length > 0 ? Vector2f(vector / length) : Vector2f::Zero();
}

/// Drawn segments by the cells of a grid over the canvas, so that those within reach are found at once.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<render::Stroke>& strokes, float reach) : cell_(std::max(reach, 2.0f)) {
    side_ = static_cast<int>(std::ceil(render::kSketchCanvas / cell_)) + 2;
    cells_.resize(size_t(side_) * size_t(side_));
    for (const render::Stroke& stroke : strokes) {
      for (size_t i = 1; i < stroke.points.size(); ++i) {
        const Vector2f from(stroke.points[i - 1][0], stroke.points[i - 1][1]),
            to(stroke.points[i][0], stroke.points[i][1]);
        const int index = static_cast<int>(segments_.size());
        segments_.push_back({from, to, Unit(to - from)});
        const auto [left, right] = std::minmax({Cell(from.x()), Cell(to.x())});
        const auto [top, bottom] = std::minmax({Cell(from.y()), Cell(to.y())});
        for (int row = top; row <= bottom; ++row) {
          for (int column = left; column <= right; ++column) At(row, column).push_back(index);
        }
      }
    }
  }

  /// The nearest point within reach on a segment whose direction is within the cosine's angle; nothing else changes.
  bool Snap(const Vector2f& point, const Vector2f& direction, float reach, float least_cosine,
            Vector2f& snapped) const {
    float best = reach;
    for (int row = Cell(point.y()) - 1; row <= Cell(point.y()) + 1; ++row) {
      for (int column = Cell(point.x()) - 1; column <= Cell(point.x()) + 1; ++column) {
        if (row < 0 || column < 0 || row >= side_ || column >= side_) continue;
        for (const int index : cells_[size_t(row * side_ + column)]) {
          const Segment& segment = segments_[size_t(index)];
          if (std::abs(segment.direction.dot(direction)) < least_cosine) continue;
          const Vector2f nearest = segment.Nearest(point);
          const float distance = (nearest - point).norm();
          if (distance < best) best = distance, snapped = nearest;
        }
      }
    }
    return best < reach;
  }

 private:
  /// One cell of margin on each side takes all that lies outside.
  int Cell(float coordinate) const {
    return std::clamp(static_cast<int>(std::floor(coordinate / cell_)) + 1, 0, side_ - 1);
  }
  std::vector<int>& At(int row, int column) { return cells_[size_t(row * side_ + column)]; }

  float cell_;
  int side_ = 0;
  std::vector<Segment> segments_;
  std::vector<std::vector<int>> cells_;
};

Vector2f PointAt(std::span<const float> points, int k) {
  return {points[2 * size_t(k)], points[2 * size_t(k) + 1]};
}

}  // namespace

faces::CurveCode RecoverCurves(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               std::span<const float> predicted, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options) {
  DAUMIER_CHECK(!offsets.empty() && offsets.front() == 0 && offsets.back() == encoder.num_points(),
                "curves of {} points for a model of {}", offsets.empty() ? 0 : offsets.back(), encoder.num_points());
  std::vector<float> weights(size_t(encoder.num_points()), 1.0f);
  faces::CurveCode code = encoder.Encode(predicted, weights);
  std::vector<float> target(predicted.begin(), predicted.end());
  std::vector<float> current = target;
  const float least_cosine = float(std::cos(options.max_angle * std::numbers::pi / 180));
  const SegmentGrid grid(strokes, float(options.reach_px));
  float reach = float(options.reach_px);
  for (int snap = 0; snap < options.snaps; ++snap, reach *= 0.5f) {
    for (size_t curve = 0; curve + 1 < offsets.size(); ++curve) {
      for (int k = offsets[curve]; k < offsets[curve + 1]; ++k) {
        const Vector2f point = PointAt(current, k);
        const Vector2f direction = Unit(PointAt(current, std::min(k + 1, offsets[curve + 1] - 1)) -
                                        PointAt(current, std::max(k - 1, offsets[curve])));
        Vector2f snapped = point;
        float& weight = weights[size_t(k)];
        weight = 0;
        if (!grid.Snap(point, direction, reach, least_cosine, snapped)) continue;
        const float share = (snapped - point).squaredNorm() / (reach * reach);
        weight = (1 - share) * (1 - share);
        target[2 * size_t(k)] = snapped.x(), target[2 * size_t(k) + 1] = snapped.y();
      }
    }
    code = encoder.Encode(target, weights, &code);
    std::copy(code.points.begin(), code.points.end(), current.begin());
  }
  return code;
}

}  // namespace daumier::fitting
