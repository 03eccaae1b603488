#include "datasets/read/stroke_deformation.h"

#include "datasets/read/stroke_arc.h"
#include "geometry/moving_least_squares.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using geometry::MovingLeastSquares;
using geometry::PlanarMap;

/// Pixels between two handles of a stroke, about.
constexpr double kHandleSpacing = 32;
constexpr int kMaxRetries = 10;

void Follow(render::Stroke& stroke, const MovingLeastSquares& map) {
  for (auto& point : stroke.points) point = ToPoint(map.Apply(ToVector(point)));
}

double Straightness(const render::Stroke& stroke, bool closed, double length) {
  const Vector2d first = ToVector(stroke.points.front());
  if (!closed) return (ToVector(stroke.points.back()) - first).norm() / length;
  double farthest = 0;
  for (const auto& point : stroke.points) farthest = std::max(farthest, (ToVector(point) - first).norm());
  return farthest / (0.5 * length);
}

/// Whether moving handle `moved` to `target` keeps its order to all others, where they were and where they are now.
bool KeepsOrder(const std::vector<Vector2d>& handles, const std::vector<Vector2d>& targets, size_t moved,
                const Vector2d& target) {
  for (size_t other = 0; other < handles.size(); ++other) {
    if (other == moved) continue;
    const Vector2d before = handles[moved] - handles[other], after = target - targets[other];
    if ((before.array() * after.array() < 0).any()) return false;
  }
  return true;
}

}  // namespace

render::Stroke DeformStroke(render::Stroke stroke, double shift_px, Rng& rng) {
  const StrokeArc arc(stroke);
  const double length = arc.length();
  if (stroke.points.size() < 3 || length == 0) return stroke;
  const bool closed = IsClosed(stroke);
  const int num_spans = std::max(closed ? 2 : 1, static_cast<int>(std::lround(length / kHandleSpacing)));
  std::vector<Vector2d> handles(size_t(num_spans) + (closed ? 0 : 1));
  for (size_t i = 0; i < handles.size(); ++i) handles[i] = arc.PointAt(length * double(i) / num_spans);

  const double reach = shift_px * Straightness(stroke, closed, length);
  const double x = rng.Below(2) ? reach : -reach, y = rng.Below(2) ? reach : -reach;
  const size_t fixed = rng.Below(handles.size());
  std::vector<Vector2d> targets = handles;
  for (size_t i = 0; i < handles.size(); ++i) {
    const double along_x = std::abs(rng.Normal()), along_y = std::abs(rng.Normal());
    if (i != fixed) targets[i] += Vector2d(x * along_x, y * along_y);
  }
  Follow(stroke, MovingLeastSquares(handles, targets, PlanarMap::kSimilarity));
  return stroke;
}

std::vector<render::Stroke> DeformDrawing(std::vector<render::Stroke> strokes, double shift_px, Rng& rng) {
  std::vector<Vector2d> points;
  for (const render::Stroke& stroke : strokes)
    for (const auto& point : stroke.points) points.push_back(ToVector(point));
  if (points.empty()) return strokes;
  const auto by_x = [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); };
  const auto by_y = [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); };
  const auto [left, right] = std::minmax_element(points.begin(), points.end(), by_x);
  const auto [top, bottom] = std::minmax_element(points.begin(), points.end(), by_y);
  std::vector<Vector2d> handles;
  for (const auto& extreme : {left, right, top, bottom})
    if (std::find(handles.begin(), handles.end(), *extreme) == handles.end()) handles.push_back(*extreme);

  std::vector<Vector2d> targets = handles;
  int num_retries = 0;
  for (size_t i = 0; i < handles.size(); ++i) {
    for (;; ++num_retries) {
      const double along_x = rng.Normal(), along_y = rng.Normal();
      const Vector2d target = handles[i] + shift_px * Vector2d(along_x, along_y);
      if (KeepsOrder(handles, targets, i, target)) {
        targets[i] = target;
        break;
      }
      if (num_retries == kMaxRetries) break;
    }
  }
  const MovingLeastSquares map(handles, targets, PlanarMap::kRigid);
  for (render::Stroke& stroke : strokes) Follow(stroke, map);
  return strokes;
}

}  // namespace daumier::datasets
