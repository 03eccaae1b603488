#include "render/svg_rings.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Share of its box that a rectangle covers at least, its corners being rounded.
constexpr double kRectangleShare = 0.94;
/// Distance of a point from a chord, in lengths of the chord, from which a line is bent: less is rounding.
constexpr double kLeastBend = 1e-6;

double TwiceAreaOf(const SvgPolyline& polyline) {
  const auto& points = polyline.points;
  double twice_area = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice_area);
}

}  // namespace

AlignedBox2d BoxOfLine(const SvgPolyline& polyline) {
  AlignedBox2d box;
  for (const auto& point : polyline.points) box.extend(point);
  return box;
}

AlignedBox2d BoxOfLines(const std::vector<SvgPolyline>& polylines) {
  AlignedBox2d box;
  for (const auto& polyline : polylines) box.extend(BoxOfLine(polyline));
  return box;
}

bool HasInside(const SvgPolyline& polyline) {
  // The signed area of a line that crosses itself may be 0.
  Vector2d chord(0, 0);
  for (const Vector2d& point : polyline.points) {
    const Vector2d other = point - polyline.points[0];
    if (other.squaredNorm() > chord.squaredNorm()) chord = other;
  }
  return std::ranges::any_of(polyline.points, [&](const Vector2d& point) {
    const Vector2d other = point - polyline.points[0];
    return std::abs(chord.x() * other.y() - chord.y() * other.x()) > kLeastBend * chord.squaredNorm();
  });
}

std::optional<AlignedBox2d> RectangleOf(const SvgPolyline& polyline) {
  const AlignedBox2d box = BoxOfLine(polyline);
  const auto& points = polyline.points;
  if (points.size() < 4 || box.sizes().minCoeff() <= 0.0) return std::nullopt;
  if ((points.front() - points.back()).norm() > 0.01 * box.sizes().maxCoeff()) return std::nullopt;
  if (0.5 * TwiceAreaOf(polyline) < kRectangleShare * box.volume()) return std::nullopt;
  return box;
}

}  // namespace daumier::render
