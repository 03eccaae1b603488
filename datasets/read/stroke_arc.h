#pragma once
#include "render/strokes.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::datasets {

/// A polyline by its length: arc lengths in pixels from its first point on.
class StrokeArc {
 public:
  /// The stroke has to outlive it.
  explicit StrokeArc(const render::Stroke& stroke);

  /// 0 of a stroke with fewer than two points.
  double length() const { return arc_lengths_.empty() ? 0 : arc_lengths_.back(); }
  /// Of each point.
  const std::vector<double>& arc_lengths() const { return arc_lengths_; }
  /// The point at an arc length, on the segment that holds it; an end of the stroke beyond it.
  /// @throws Error if the stroke has no point.
  Eigen::Vector2d PointAt(double arc_length) const;

 private:
  const render::Stroke& stroke_;
  std::vector<double> arc_lengths_;
};

/// Whether a stroke of three points or more ends where it begins.
bool IsClosed(const render::Stroke& stroke);

inline Eigen::Vector2d ToVector(const std::array<float, 2>& point) {
  return {point[0], point[1]};
}
inline std::array<float, 2> ToPoint(const Eigen::Vector2d& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y())};
}

}  // namespace daumier::datasets
