#include "datasets/read/stroke_arc.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::datasets {

StrokeArc::StrokeArc(const render::Stroke& stroke) : stroke_(stroke), arc_lengths_(stroke.points.size(), 0.0) {
  for (size_t i = 1; i < arc_lengths_.size(); ++i)
    arc_lengths_[i] = arc_lengths_[i - 1] + (ToVector(stroke.points[i]) - ToVector(stroke.points[i - 1])).norm();
}

Eigen::Vector2d StrokeArc::PointAt(double arc_length) const {
  DAUMIER_CHECK(!arc_lengths_.empty(), "a stroke without points has no point at an arc length");
  const auto next = std::upper_bound(arc_lengths_.begin(), arc_lengths_.end(), arc_length);
  if (next == arc_lengths_.begin()) return ToVector(stroke_.points.front());
  if (next == arc_lengths_.end()) return ToVector(stroke_.points.back());
  const size_t i = size_t(next - arc_lengths_.begin());
  const double share = (arc_length - arc_lengths_[i - 1]) / (arc_lengths_[i] - arc_lengths_[i - 1]);
  return (1 - share) * ToVector(stroke_.points[i - 1]) + share * ToVector(stroke_.points[i]);
}

bool IsClosed(const render::Stroke& stroke) {
  return stroke.points.size() >= 3 && stroke.points.front() == stroke.points.back();
}

}  // namespace daumier::datasets
