#include "systems/sketch/session_pen.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::sketch {
namespace {

constexpr double kStepsOfString = 8;
constexpr size_t kMostSteps = 100'000;  // Between two points of a path.

}  // namespace

PenLine WithWeight(const CanvasPoints& path, const Pen& pen) {
  DAUMIER_CHECK(std::isfinite(pen.weight) && pen.weight >= 0, "a weight of {:g} pixels (expected a positive one)",
                pen.weight);
  DAUMIER_CHECK(pen.pressure.empty() || pen.weight > 0, "the pressure of a pen without a weight");
  DAUMIER_CHECK(pen.pressure.empty() || pen.pressure.size() == path.size(), "the pressure at {} points of {}",
                pen.pressure.size(), path.size());
  PenLine line{path};
  if (pen.weight == 0) return line;
  line.widths.assign(path.size(), pen.weight);
  for (size_t i = 0; i < pen.pressure.size(); ++i) {
    DAUMIER_CHECK(pen.pressure[i] >= 0 && pen.pressure[i] <= 1, "a pressure of {:g} (expected 0 to 1)",
                  pen.pressure[i]);
    line.widths[i] *= std::max(pen.pressure[i], kLeastPressure);
  }
  return line;
}

PenLine Stabilised(const PenLine& path, double string) {
  DAUMIER_CHECK(string >= 0 && string <= kLongestString, "a stabiliser of {:g} pixels (expected 0 to {})", string,
                kLongestString);
  const CanvasPoints& points = path.points;
  DAUMIER_CHECK(!points.empty(), "a stroke has no point");
  DAUMIER_CHECK(std::ranges::all_of(points, [](const Eigen::Vector2d& p) { return p.allFinite(); }),
                "a stroke has a point that is not finite");
  if (string == 0) return path;
  PenLine line;
  const auto add = [&](const Eigen::Vector2d& point, size_t from, size_t to, double share) {
    line.points.push_back(point);
    if (path.widths.empty()) return;
    line.widths.push_back(path.widths[from] + share * (path.widths[to] - path.widths[from]));
  };
  add(points.front(), 0, 0, 0);
  for (size_t i = 1; i < points.size(); ++i) {
    const double length = (points[i] - points[i - 1]).norm();
    const size_t steps = 1 + std::min(kMostSteps, size_t(length * kStepsOfString / string));
    for (size_t k = 1; k <= steps; ++k) {
      const double share = double(k) / double(steps);
      const Eigen::Vector2d pen = points[i - 1] + share * (points[i] - points[i - 1]);
      const Eigen::Vector2d behind = line.points.back() - pen;
      if (behind.norm() > string) add(pen + string * behind.normalized(), i - 1, i, share);
    }
  }
  if (line.points.back() != points.back()) add(points.back(), points.size() - 1, points.size() - 1, 0);
  return line;
}

CanvasPoints Mirrored(CanvasPoints line, double axis) {
  for (Eigen::Vector2d& point : line) point.x() = 2 * axis - point.x();
  return line;
}

std::vector<PenLine> WithMirrorImage(const PenLine& line, double axis, double reach) {
  DAUMIER_CHECK(!line.points.empty(), "a stroke has no point");
  const PenLine image{Mirrored(line.points, axis), line.widths};
  const auto is_on = [&](const CanvasPoints& other) {
    return std::ranges::all_of(line.points,
                               [&](const Eigen::Vector2d& p) { return datasets::DistanceTo(other, p) <= reach; });
  };
  if (is_on(image.points)) return {line};
  const bool begins_there = std::abs(line.points.front().x() - axis) <= reach,
             ends_there = std::abs(line.points.back().x() - axis) <= reach;
  if (!begins_there && !ends_there) return {line, image};
  if (!ends_there) return {Joined(Reversed(line), image)};
  PenLine joined = Joined(line, Reversed(image));
  if (begins_there) {
    joined.points.push_back(joined.points.front());
    if (!joined.widths.empty()) joined.widths.push_back(joined.widths.front());
  }
  return {joined};
}

}  // namespace daumier::sketch
