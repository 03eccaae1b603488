#include "render/line_reduction.h"

#include <algorithm>
#include <utility>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

double DistanceToChord(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double length_squared = along.squaredNorm();
  const double t = length_squared > 0.0 ? std::clamp((point - from).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (point - from - t * along).norm();
}

}  // namespace

std::vector<int> ReducedLine(const std::vector<Vector2d>& line, double tolerance) {
  if (line.empty()) return {};
  std::vector<bool> is_kept(line.size(), false);
  is_kept.front() = is_kept.back() = true;
  std::vector<std::pair<size_t, size_t>> spans = {{0, line.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    size_t furthest = first;
    double distance = tolerance;
    for (size_t i = first + 1; i < last; ++i) {
      const double candidate = DistanceToChord(line[i], line[first], line[last]);
      if (candidate > distance) {
        furthest = i;
        distance = candidate;
      }
    }
    if (furthest == first) continue;
    is_kept[furthest] = true;
    spans.emplace_back(first, furthest);
    spans.emplace_back(furthest, last);
  }
  std::vector<int> kept;
  for (size_t i = 0; i < line.size(); ++i)
    if (is_kept[i]) kept.push_back(static_cast<int>(i));
  return kept;
}

}  // namespace daumier::render
