#include "faces/openings.h"

#include "core/error.h"
#include "faces/face_holes.h"
#include "faces/open_mouth.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace daumier::faces {
namespace {

enum class Extreme { kHighest, kLowest };

/// The highest or lowest y of a path at x; none beyond its ends.
std::optional<double> HeightAt(const geometry::Points& points, const std::vector<int>& path, double x,
                               Extreme extreme) {
  std::optional<double> height;
  for (size_t i = 1; i < path.size(); ++i) {
    const double x0 = points(path[i - 1], 0), x1 = points(path[i], 0);
    if (x < std::min(x0, x1) || x > std::max(x0, x1)) continue;
    const double y0 = points(path[i - 1], 1), y1 = points(path[i], 1);
    double y = x0 == x1 ? y0 : y0 + (x - x0) / (x1 - x0) * (y1 - y0);
    if (x0 == x1) y = extreme == Extreme::kHighest ? std::max(y0, y1) : std::min(y0, y1);
    if (!height || (extreme == Extreme::kHighest ? y > *height : y < *height)) height = y;
  }
  return height;
}

}  // namespace

Opening DivideLoop(const geometry::Points& points, std::vector<int> loop) {
  if (loop.empty()) return {};
  const auto by_x = [&](int a, int b) { return points(a, 0) < points(b, 0); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_x), loop.end());
  const auto corner = std::max_element(loop.begin(), loop.end(), by_x);
  Opening opening;
  opening.upper.assign(loop.begin(), corner + 1);
  opening.lower.assign(corner, loop.end());
  opening.lower.push_back(loop.front());
  std::reverse(opening.lower.begin(), opening.lower.end());
  // Copied first: Eigen 3.4.0 sums an indexed column of a row-major matrix wrongly.
  const auto height = [&](const std::vector<int>& path) { return Eigen::VectorXd(points(path, 1)).mean(); };
  if (height(opening.upper) < height(opening.lower)) std::swap(opening.upper, opening.lower);
  return opening;
}

FaceOpenings FindOpenings(const FaceTemplate& face_template) {
  const auto& landmarks = face_template.annotation.landmarks;
  const auto pair = [&](int upper, int lower) { return std::pair(landmarks[upper], landmarks[lower]); };
  FaceOpenings openings;
  const LipContours lips = FindLipContours(face_template);
  openings.lips = {lips.upper, lips.lower, {pair(61, 67), pair(62, 66), pair(63, 65)}};
  const FaceHoles holes = FindHoles(face_template);
  openings.lids = {DivideLoop(face_template.neutral, holes.eye_right),
                   DivideLoop(face_template.neutral, holes.eye_left)};
  openings.lids[0].pairs = {pair(37, 41), pair(38, 40)};
  openings.lids[1].pairs = {pair(43, 47), pair(44, 46)};
  return openings;
}

double MeanGap(const Opening& opening, const geometry::Points& points) {
  DAUMIER_CHECK(!opening.pairs.empty(), "an opening without pairs of vertices has no gap");
  double sum = 0;
  for (const auto& [upper, lower] : opening.pairs) sum += points(upper, 1) - points(lower, 1);
  return sum / static_cast<double>(opening.pairs.size());
}

double CrossingDepth(const Opening& opening, const geometry::Points& points) {
  double depth = 0;
  for (const int v : opening.lower) {
    if (const auto upper = HeightAt(points, opening.upper, points(v, 0), Extreme::kHighest))
      depth = std::max(depth, points(v, 1) - *upper);
  }
  for (const int v : opening.upper) {
    if (const auto lower = HeightAt(points, opening.lower, points(v, 0), Extreme::kLowest))
      depth = std::max(depth, *lower - points(v, 1));
  }
  for (const auto& [upper, lower] : opening.pairs) depth = std::max(depth, points(lower, 1) - points(upper, 1));
  return depth;
}

}  // namespace daumier::faces
