#include "render/loose_ends.h"

#include "render/ink.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using LinePoints = std::vector<Vector2d>;

/// Half widths at the end of a line that thinning bends, and over which the direction of the line is taken.
constexpr double kBentHalfWidths = 1.5, kDirectionHalfWidths = 1.2;
/// Half widths before the edge of the ink from where on a line goes straight on: rays across it would leave at its end.
constexpr double kStraightHalfWidths = 0.7;
/// Distance to the edge of the ink, in half widths, beyond which a point is not in a line of that width.
constexpr double kMaxHalfWidths = 1.6;
/// Of the pixels along the middle of the ink, one in this number is a point of the line.
constexpr size_t kKeptSteps = 3;
/// Depth of the strip at the tip of a line by whose share of ink its end is known, and half its breadth, in half widths
/// of the line. The share is 1 where the line is cut straight, 0.68 where it is round, and less where it runs to a
/// point.
constexpr double kStripDepth = 0.5, kStripBreadth = 0.9, kStraightShare = 0.84, kRoundShare = 0.45;
/// Steps along the ray to the edge of the ink, in pixels.
constexpr double kRayStep = 0.25;

/// The ink at points in pixels.
class InkAt {
 public:
  explicit InkAt(const Image& ink) : ink_(ink) {
    cv::Mat inverted, padded;
    cv::bitwise_not(MatView(ink), inverted);
    cv::copyMakeBorder(inverted, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::distanceTransform(padded, distance_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  }

  bool IsInk(const Vector2d& point) const {
    return IsInside(point) && ink_.at(static_cast<int>(point.y()), static_cast<int>(point.x())) == kInk;
  }

  /// Distance to the edge of the ink; 0 on paper.
  double HalfWidth(const Vector2d& point) const {
    if (!IsInk(point)) return 0.0;
    return distance_.at<float>(static_cast<int>(point.y()) + 1, static_cast<int>(point.x()) + 1) - 0.5;
  }

 private:
  bool IsInside(const Vector2d& point) const {
    return point.x() >= 0 && point.y() >= 0 && point.x() < ink_.width && point.y() < ink_.height;
  }

  const Image& ink_;
  cv::Mat distance_;
};

/// The share of ink in the strip behind the tip.
double ShareAtTip(const InkAt& ink, const Vector2d& tip, const Vector2d& direction, double half_width) {
  constexpr int kSteps = 12;
  const Vector2d across(-direction.y(), direction.x());
  int num_ink = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double back = kStripDepth * (i + 0.5) / kSteps, aside = kStripBreadth * (2.0 * (j + 0.5) / kSteps - 1.0);
      num_ink += ink.IsInk(tip + half_width * (aside * across - back * direction));
    }
  }
  return static_cast<double>(num_ink) / (kSteps * kSteps);
}

/// A line without its first `length`, which is less than all of it.
LinePoints CutAtFront(const LinePoints& line, double length) {
  size_t i = 1;
  double step = 0.0;
  while (i + 1 < line.size() && (step = (line[i] - line[i - 1]).norm()) <= length) {
    length -= step;
    ++i;
  }
  step = (line[i] - line[i - 1]).norm();
  const double t = step > 0.0 ? std::min(1.0, length / step) : 0.0;
  LinePoints rest = {line[i - 1] + t * (line[i] - line[i - 1])};
  rest.insert(rest.end(), line.begin() + static_cast<int64_t>(i), line.end());
  return rest;
}

double LengthOf(const LinePoints& line) {
  double length = 0.0;
  for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// The point at a length along a line, or its last.
Vector2d PointAt(const LinePoints& line, double length) {
  return CutAtFront(line, std::min(length, LengthOf(line))).front();
}

/// The point in the middle between the edges of the ink to both sides of a point, if both are within reach.
Vector2d Centred(const InkAt& ink, const Vector2d& point, const Vector2d& ahead, double reach) {
  const Vector2d across(-ahead.y(), ahead.x());
  std::array<double, 2> lengths{};
  for (const int side : {0, 1}) {
    const Vector2d step = (side == 0 ? 1.0 : -1.0) * across;
    double& length = lengths[side];
    while (length < reach && ink.IsInk(point + (length + kRayStep) * step)) length += kRayStep;
    if (length >= reach) return point;
  }
  return point + 0.5 * (lengths[0] - lengths[1]) * across;
}

/// The middle of the ink from a point on, a pixel a step, to the edge of the ink; empty if that is not within reach.
LinePoints FollowToTip(const InkAt& ink, const Vector2d& start, Vector2d ahead, double half_width, double reach) {
  LinePoints middle = {start};
  const auto num_behind = std::max<int64_t>(2, std::lround(kDirectionHalfWidths * half_width));
  bool is_near_tip = false;
  while (std::ssize(middle) <= reach) {
    const Vector2d next = middle.back() + ahead;
    if (!ink.IsInk(next)) {
      double length = 0.0;
      while (length < 1.0 && ink.IsInk(middle.back() + (length + kRayStep) * ahead)) length += kRayStep;
      middle.push_back(middle.back() + length * ahead);
      return middle;
    }
    is_near_tip = is_near_tip || !ink.IsInk(next + kStraightHalfWidths * half_width * ahead);
    middle.push_back(is_near_tip ? next : Centred(ink, next, ahead, kMaxHalfWidths * half_width));
    if (is_near_tip) continue;
    const auto behind = std::max<int64_t>(0, std::ssize(middle) - 1 - num_behind);
    const Vector2d along = middle.back() - middle[behind];
    if (std::ssize(middle) > num_behind && along.squaredNorm() > 0.0) ahead = along.normalized();
  }
  return {};
}

/// A line whose front is loose, with its front where the pen's end is.
LinePoints WithFullFront(const LinePoints& line, const InkAt& ink, double pen_width) {
  const double length = LengthOf(line);
  double half_width = 0.0;
  for (double at = 0.0; at <= std::min(pen_width, length); at += 1.0) {
    half_width = std::max(half_width, ink.HalfWidth(PointAt(line, at)));
  }
  const double cut = std::min(kBentHalfWidths * half_width, 0.5 * length);
  const Vector2d start = PointAt(line, cut);
  const Vector2d along = start - PointAt(line, cut + half_width);
  if (half_width <= 0.0 || along.squaredNorm() == 0.0) return line;

  LinePoints middle = FollowToTip(ink, start, along.normalized(), half_width, cut + 2.0 * half_width + 2.0);
  if (middle.empty()) return line;  // More ink follows: no end of a line, but a corner.
  std::reverse(middle.begin(), middle.end());
  const Vector2d ahead = (middle.front() - PointAt(middle, half_width)).normalized();
  const double share = ShareAtTip(ink, middle.front(), ahead, half_width);
  const bool is_round = share > kRoundShare && share <= kStraightShare;
  if (is_round) middle = CutAtFront(middle, std::min(half_width, LengthOf(middle)));

  LinePoints extended;
  for (size_t i = 0; i + 1 < middle.size(); i += kKeptSteps) extended.push_back(middle[i]);
  const LinePoints rest = CutAtFront(line, cut);
  extended.insert(extended.end(), rest.begin(), rest.end());
  return extended;
}

}  // namespace

std::vector<Stroke> WithFullEnds(std::vector<Stroke> strokes, const SkeletonGraph& graph, const Image& ink,
                                 double pen_width) {
  const auto degrees = graph.Degrees();
  std::set<std::array<float, 2>> loose;
  for (size_t i = 0; i < graph.nodes.size(); ++i) {
    const Vector2d& position = graph.nodes[i].position;
    if (degrees[i] == 1) loose.insert({static_cast<float>(position.x()), static_cast<float>(position.y())});
  }
  const InkAt ink_at(ink);
  for (Stroke& stroke : strokes) {
    if (stroke.points.size() < 2) continue;
    const std::array is_loose = {loose.contains(stroke.points.back()), loose.contains(stroke.points.front())};
    LinePoints line;
    for (const auto& [x, y] : stroke.points) line.emplace_back(x, y);
    for (const bool is_loose_end : is_loose) {
      std::reverse(line.begin(), line.end());
      if (is_loose_end) line = WithFullFront(line, ink_at, pen_width);
    }
    stroke.points.clear();
    for (const Vector2d& point : line) {
      stroke.points.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
    }
  }
  return strokes;
}

}  // namespace daumier::render
