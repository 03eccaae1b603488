#include "systems/sketch/session_pen.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::sketch {
namespace {

constexpr double kStepsOfString = 8;
constexpr size_t kMostSteps = 100'000;  // Between two points of a path.

}  // namespace

CanvasPoints Stabilised(const CanvasPoints& path, double string) {
  DAUMIER_CHECK(string >= 0 && string <= kLongestString, "a stabiliser of {:g} pixels (expected 0 to {})", string,
                kLongestString);
  DAUMIER_CHECK(!path.empty(), "a stroke has no point");
  DAUMIER_CHECK(std::ranges::all_of(path, [](const Eigen::Vector2d& p) { return p.allFinite(); }),
                "a stroke has a point that is not finite");
  if (string == 0) return path;
  CanvasPoints line{path.front()};
  for (size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    const size_t steps = 1 + std::min(kMostSteps, size_t(length * kStepsOfString / string));
    for (size_t k = 1; k <= steps; ++k) {
      const Eigen::Vector2d pen = path[i - 1] + double(k) / double(steps) * (path[i] - path[i - 1]);
      const Eigen::Vector2d behind = line.back() - pen;
      if (behind.norm() > string) line.push_back(pen + string * behind.normalized());
    }
  }
  if (line.back() != path.back()) line.push_back(path.back());
  return line;
}

CanvasPoints Mirrored(CanvasPoints line, double axis) {
  for (Eigen::Vector2d& point : line) point.x() = 2 * axis - point.x();
  return line;
}

std::vector<CanvasPoints> WithMirrorImage(const CanvasPoints& line, double axis, double reach) {
  DAUMIER_CHECK(!line.empty(), "a stroke has no point");
  const CanvasPoints image = Mirrored(line, axis);
  const auto is_on = [&](const CanvasPoints& other) {
    return std::ranges::all_of(line, [&](const Eigen::Vector2d& p) { return datasets::DistanceTo(other, p) <= reach; });
  };
  if (is_on(image)) return {line};
  const bool begins_there = std::abs(line.front().x() - axis) <= reach,
             ends_there = std::abs(line.back().x() - axis) <= reach;
  if (!begins_there && !ends_there) return {line, image};
  if (!ends_there) return {datasets::Joined(datasets::Reversed(line), image)};
  CanvasPoints joined = datasets::Joined(line, datasets::Reversed(image));
  if (begins_there) joined.push_back(joined.front());
  return {joined};
}

}  // namespace daumier::sketch
