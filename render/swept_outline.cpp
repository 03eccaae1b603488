#include "render/swept_outline.h"

#include "core/error.h"
#include "core/statistics.h"
#include "render/filled_area.h"
#include "render/ink.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Points along the outline by which its end is found, how many of them are tried, and points in a width for the line.
constexpr int kNumOutlinePoints = 512, kNumEndTrials = 64, kPointsOfWidth = 16, kMaxOutlinePoints = 4096;
/// Pixels of the longer side of the mask by which the covered area is measured, and by how much the outline is turned
/// there, in radians: rounding of edges along the pixels would not cancel.
constexpr double kCoverSide = 1000.0, kCoverTurn = 0.35;
/// Share of an outline's area by which what it covers differs if it covers or crosses itself.
constexpr double kSelfCover = 0.02;
/// Length of a line, in its widths.
constexpr double kMinSweptLength = 3.0;
/// Length of a round cap, that of one gone round one and a half times, and how far the middle of the sides is from the
/// end of the line there, in the line's width.
constexpr double kCapLength = 1.65, kLongCapLength = 4.85, kCapReach = 0.65;

struct SidePair {
  int left, right;  ///< Points of the outline, counted from the end: left forwards, right backwards.
};

std::vector<Vector2d> EvenlySpaced(const std::vector<Vector2d>& outline, int count) {
  std::vector<double> arc{0.0};
  for (size_t i = 0; i < outline.size(); ++i)
    arc.push_back(arc.back() + (outline[(i + 1) % outline.size()] - outline[i]).norm());
  std::vector<Vector2d> points;
  size_t segment = 0;
  for (int k = 0; k < count; ++k) {
    const double at = arc.back() * k / count;
    while (arc[segment + 1] < at) ++segment;
    const double length = arc[segment + 1] - arc[segment];
    const double t = length > 0.0 ? (at - arc[segment]) / length : 0.0;
    points.emplace_back((1.0 - t) * outline[segment] + t * outline[(segment + 1) % outline.size()]);
  }
  return points;
}

/// Whether the area that an outline covers differs from the one between it and itself, the sense of which counts.
bool CoversItself(const std::vector<Vector2d>& outline) {
  FilledArea area{{outline}, FillRule::kNonzero};
  for (Vector2d& point : area.outlines[0]) point = Eigen::Rotation2Dd(kCoverTurn) * point;
  const auto box = area.Box();
  const double side = box.sizes().maxCoeff();
  if (!(side > 0.0)) return false;
  double doubled = 0.0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vector2d from = outline[i] - outline[0], to = outline[(i + 1) % outline.size()] - outline[0];
    doubled += from.x() * to.y() - from.y() * to.x();
  }
  const double scale = kCoverSide / side;
  Image mask(static_cast<int>(scale * box.sizes().y()) + 1, static_cast<int>(scale * box.sizes().x()) + 1, 1, kPaper);
  FillArea(area, {box.min(), scale}, kInk, mask);
  const double covered = static_cast<double>(std::ranges::count(mask.pixels, kInk)) / (scale * scale);
  return covered > 0.0 && std::abs(0.5 * std::abs(doubled) - covered) > kSelfCover * covered;
}

class OutlineSides {
 public:
  OutlineSides(const std::vector<Vector2d>& points, int end) : points_(points), end_(end) {}

  /// The pairs from the end on; `cost` becomes the mean distance of their points.
  std::vector<SidePair> Pairs(double& cost) const {
    std::vector<SidePair> pairs{{0, 0}};
    cost = 0.0;
    while (pairs.back().left + pairs.back().right < std::ssize(points_) - 1) {
      const auto [left, right] = pairs.back();
      SidePair next{left + 1, right + 1};
      for (const SidePair other : {SidePair{left + 1, right}, SidePair{left, right + 1}})
        if (WidthAt(other) < WidthAt(next)) next = other;
      cost += WidthAt(next);
      pairs.push_back(next);
    }
    cost /= static_cast<double>(pairs.size());
    return pairs;
  }

  Vector2d Left(const SidePair& pair) const { return At(end_ + pair.left); }
  Vector2d Right(const SidePair& pair) const { return At(end_ - pair.right); }
  double WidthAt(const SidePair& pair) const { return (Left(pair) - Right(pair)).norm(); }
  Vector2d Middle(const SidePair& pair) const { return 0.5 * (Left(pair) + Right(pair)); }

 private:
  const Vector2d& At(int index) const {
    const int size = static_cast<int>(points_.size());
    return points_[static_cast<size_t>(((index % size) + size) % size)];
  }

  const std::vector<Vector2d>& points_;
  int end_;
};

/// The point near one, in a range around it, from which the pairs lie nearest.
int BestEnd(const std::vector<Vector2d>& points, int centre, int range, int stride) {
  int best = centre;
  double least = std::numeric_limits<double>::infinity(), cost = 0.0;
  for (int end = centre - range / 2; end <= centre + range / 2; end += stride) {
    OutlineSides(points, end).Pairs(cost);
    if (cost >= least) continue;
    least = cost;
    best = end;
  }
  return best;
}

/// Pairs within the cap of the end from which `num_passed(pair)` counts the points: up to the last whose sides have come
/// no farther than around a round cap. A point has no cap. perfect-freehand goes round its last cap one and a half
/// times, while the middle of the sides stays where it is.
template <class NumPassed>
size_t NumInCap(const OutlineSides& sides, const std::vector<SidePair>& pairs, double step, NumPassed&& num_passed) {
  size_t num_in_cap = 0, num_in_long_cap = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double way = step * num_passed(pairs[k]), width = sides.WidthAt(pairs[k]);
    if (way <= kCapLength * width) num_in_cap = k + 1;
    if (way <= kLongCapLength * width) num_in_long_cap = k + 1;
  }
  if (num_in_long_cap == 0) return 0;
  const SidePair& last = pairs[num_in_long_cap - 1];
  const bool stays =
      std::all_of(pairs.begin(), pairs.begin() + static_cast<ptrdiff_t>(num_in_long_cap), [&](const auto& pair) {
        return (sides.Middle(pair) - sides.Middle(last)).norm() <= kCapReach * sides.WidthAt(last);
      });
  return stays ? num_in_long_cap : num_in_cap;
}

}  // namespace

std::optional<SweptLine> LineOfSweptOutline(const std::vector<Vector2d>& outline) {
  for (const Vector2d& point : outline) DAUMIER_CHECK(point.allFinite(), "a point of an outline is not finite");
  if (outline.size() < 4 || !CoversItself(outline)) return std::nullopt;
  double perimeter = 0.0;
  for (size_t i = 0; i < outline.size(); ++i) perimeter += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  constexpr int kStride = kNumOutlinePoints / kNumEndTrials;
  const auto coarse = EvenlySpaced(outline, kNumOutlinePoints);
  const int coarse_end = BestEnd(coarse, BestEnd(coarse, 0, kNumOutlinePoints, kStride), 2 * kStride, 1);
  double width = 0.0;
  OutlineSides(coarse, coarse_end).Pairs(width);
  const int count = static_cast<int>(
      std::clamp(kPointsOfWidth * perimeter / width, double(kNumOutlinePoints), double(kMaxOutlinePoints)));
  const double step = perimeter / count, fineness = double(count) / kNumOutlinePoints;
  const auto points = EvenlySpaced(outline, count);
  const int end = BestEnd(points, static_cast<int>(fineness * coarse_end), static_cast<int>(2.0 * fineness) + 1, 1);
  const OutlineSides sides(points, end);
  const auto pairs = sides.Pairs(width);
  std::vector<double> widths;
  for (const SidePair& pair : pairs) widths.push_back(sides.WidthAt(pair));
  SweptLine swept;
  swept.pen_width = Median(widths);
  swept.width = Percentile(widths, 90.0);
  const auto reversed = std::vector(pairs.rbegin(), pairs.rend());
  const size_t first = NumInCap(sides, pairs, step, [](const SidePair& pair) { return pair.left + pair.right; });
  const size_t last =
      NumInCap(sides, reversed, step, [&](const SidePair& pair) { return count - pair.left - pair.right; });
  for (size_t k = first; k + last < pairs.size(); ++k) {
    const Vector2d middle = sides.Middle(pairs[k]);
    if (k > first) swept.length += (middle - sides.Middle(pairs[k - 1])).norm();
    swept.line.points.push_back({static_cast<float>(middle.x()), static_cast<float>(middle.y())});
  }
  if (swept.length < kMinSweptLength * swept.width) return std::nullopt;
  return swept;
}

}  // namespace daumier::render
