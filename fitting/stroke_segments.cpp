#include "fitting/stroke_segments.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

Vector2f PointOf(const render::Stroke& stroke, size_t i) {
  return {stroke.points[i][0], stroke.points[i][1]};
}

}  // namespace

Vector2f Segment::Nearest(const Vector2f& point) const {
  const Vector2f along = to - from;
  const float length2 = along.squaredNorm();
  const float share = length2 > 0 ? std::clamp((point - from).dot(along) / length2, 0.0f, 1.0f) : 0.0f;
  return from + share * along;
}

Vector2f Unit(const Vector2f& vector) {
  const float length = vector.norm();
  return length > 0 ? Vector2f(vector / length) : Vector2f::Zero();
}

std::vector<Segment> SegmentsOf(const std::vector<render::Stroke>& strokes) {
  std::vector<Segment> segments;
  for (const render::Stroke& stroke : strokes) {
    if (stroke.points.size() == 1) segments.push_back({PointOf(stroke, 0), PointOf(stroke, 0), Vector2f::Zero()});
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const Vector2f from = PointOf(stroke, i - 1), to = PointOf(stroke, i);
      segments.push_back({from, to, Unit(to - from)});
    }
  }
  return segments;
}

SegmentGrid::SegmentGrid(std::vector<Segment> segments, float reach)
    : reach_(reach), cell_(std::max(reach, 2.0f)), segments_(std::move(segments)) {
  DAUMIER_CHECK(reach > 0, "a reach of {} pixels, expected a positive number", reach);
  side_ = static_cast<int>(std::ceil(render::kSketchCanvas / cell_)) + 2;
  cells_.resize(size_t(side_) * size_t(side_));
  for (size_t index = 0; index < segments_.size(); ++index) {
    const Segment& segment = segments_[index];
    const auto [left, right] = std::minmax({Cell(segment.from.x()), Cell(segment.to.x())});
    const auto [top, bottom] = std::minmax({Cell(segment.from.y()), Cell(segment.to.y())});
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column)
        cells_[size_t(row * side_ + column)].push_back(static_cast<int>(index));
    }
  }
}

std::optional<Vector2f> SegmentGrid::Nearest(const Vector2f& point, const Vector2f& direction, float reach,
                                             float least_cosine) const {
  float best = std::min(reach, reach_);
  std::optional<Vector2f> found;
  for (int row = Cell(point.y()) - 1; row <= Cell(point.y()) + 1; ++row) {
    for (int column = Cell(point.x()) - 1; column <= Cell(point.x()) + 1; ++column) {
      if (row < 0 || column < 0 || row >= side_ || column >= side_) continue;
      for (const int index : cells_[size_t(row * side_ + column)]) {
        const Segment& segment = segments_[size_t(index)];
        if (std::abs(segment.direction.dot(direction)) < least_cosine) continue;
        const Vector2f nearest = segment.Nearest(point);
        const float distance = (nearest - point).norm();
        if (distance < best) best = distance, found = nearest;
      }
    }
  }
  return found;
}

int SegmentGrid::Cell(float coordinate) const {
  return std::clamp(static_cast<int>(std::floor(coordinate / cell_)) + 1, 0, side_ - 1);
}

}  // namespace daumier::fitting
