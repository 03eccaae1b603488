#include "render/skeleton_tracing.h"

#include "render/line_reduction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using PixelPath = std::vector<Vector2d>;

constexpr double kMaxTurn = 50.0 * std::numbers::pi / 180.0;
/// Pixels along a line, beyond the blot of the junction, over which its direction is taken.
constexpr double kDirectionLength = 8.0;
/// Standard deviation of the smoothing along a line, and how far simplified lines may be from it, in pixels.
constexpr double kSmoothing = 2.5, kSimplification = 0.25;

/// One of the two ends of an edge.
struct End {
  int edge = 0, side = 0;
  bool operator==(const End&) const = default;
};

/// The points of an edge from one of its ends to the other.
PixelPath PointsFrom(const SkeletonGraph& graph, const End& end) {
  PixelPath points = graph.edges[end.edge].points;
  if (end.side == 1) std::reverse(points.begin(), points.end());
  return points;
}

/// The direction in which an edge leaves its node, taken outside the node's radius where the edge is long enough.
Vector2d DirectionAt(const SkeletonGraph& graph, const End& end) {
  const PixelPath points = PointsFrom(graph, end);
  const double radius = graph.nodes[graph.edges[end.edge].nodes[end.side]].radius;
  const auto at_distance = [&](double distance) {
    size_t i = 0;
    while (i + 1 < points.size() && (points[i] - points[0]).norm() < distance) ++i;
    return i;
  };
  const size_t near = at_distance(radius), far = at_distance(radius + kDirectionLength);
  const Vector2d direction = points[far] - points[near == far ? 0 : near];
  return direction.squaredNorm() > 0.0 ? Vector2d(direction.normalized()) : direction;
}

class Tracer {
 public:
  explicit Tracer(const SkeletonGraph& graph)
      : graph_(graph), partners_(graph.edges.size()), is_traced_(graph.edges.size(), false) {
    std::vector<std::vector<End>> ends(graph.nodes.size());
    for (int e = 0; e < std::ssize(graph.edges); ++e) {
      for (int side = 0; side < 2; ++side) ends[graph.edges[e].nodes[side]].push_back({e, side});
    }
    for (const auto& ends_at_node : ends) {
      is_junction_.push_back(ends_at_node.size() > 2);
      PairEnds(ends_at_node);
    }
  }

  struct Line {
    PixelPath points;
    bool closed;
  };

  std::vector<Line> Trace() {
    std::vector<Line> lines;
    for (const bool open : {true, false}) {
      for (int e = 0; e < std::ssize(graph_.edges); ++e) {
        for (int side = 0; side < 2; ++side) {
          if (!is_traced_[e] && (!open || !partners_[e][side])) lines.push_back(Follow({e, side}));
        }
      }
    }
    return lines;
  }

 private:
  void PairEnds(const std::vector<End>& ends) {
    struct Pair {
      double turn;
      End a, b;
    };
    std::vector<Pair> pairs;
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t j = i + 1; j < ends.size(); ++j) {
        const double cosine = -DirectionAt(graph_, ends[i]).dot(DirectionAt(graph_, ends[j]));
        const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
        // Two ends alone are one line, whatever its corner.
        if (turn <= kMaxTurn || ends.size() == 2) pairs.push_back({turn, ends[i], ends[j]});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.turn < b.turn; });
    for (const auto& [turn, a, b] : pairs) {
      if (PartnerOf(a) || PartnerOf(b)) continue;
      PartnerOf(a) = b;
      PartnerOf(b) = a;
    }
  }

  std::optional<End>& PartnerOf(const End& end) { return partners_[end.edge][end.side]; }

  /// From an end along its edge and on through junctions, until there is no partner or the line is closed.
  Line Follow(const End& first) {
    Line line{{}, false};
    std::optional<End> start = first;
    while (start && !is_traced_[start->edge]) {
      is_traced_[start->edge] = true;
      const End last{start->edge, 1 - start->side};
      Append(*start, last, line.points);
      start = PartnerOf(last);
    }
    line.closed = start.has_value();
    if (line.closed && line.points.size() > 1) line.points.push_back(line.points.front());
    return line;
  }

  /// Where a line continues through a junction, the pixels in its blot are skipped: thinning bends them.
  void Append(const End& start, const End& last, PixelPath& line) {
    const PixelPath points = PointsFrom(graph_, start);
    const auto is_in_blot = [&](const Vector2d& point, const End& end) {
      const int node = graph_.edges[end.edge].nodes[end.side];
      return is_junction_[node] && PartnerOf(end) &&
             (point - graph_.nodes[node].position).norm() < graph_.nodes[node].radius + 1.0;
    };
    for (const auto& point : points) {
      if (is_in_blot(point, start) || is_in_blot(point, last)) continue;
      if (line.empty() || line.back() != point) line.push_back(point);
    }
    if (line.empty()) line.push_back(points[points.size() / 2]);
  }

  const SkeletonGraph& graph_;
  std::vector<std::array<std::optional<End>, 2>> partners_;
  std::vector<bool> is_traced_, is_junction_;
};

/// The same line with points about a pixel apart, its ends among them.
PixelPath Resampled(const PixelPath& line) {
  std::vector<double> lengths = {0.0};
  for (size_t i = 1; i < line.size(); ++i) lengths.push_back(lengths.back() + (line[i] - line[i - 1]).norm());
  const int num_steps = std::max(1, static_cast<int>(std::lround(lengths.back())));
  PixelPath resampled;
  size_t segment = 1;
  for (int step = 0; step <= num_steps; ++step) {
    const double length = lengths.back() * step / num_steps;
    while (segment + 1 < line.size() && lengths[segment] < length) ++segment;
    const double span = lengths[segment] - lengths[segment - 1];
    const double t = span > 0.0 ? std::clamp((length - lengths[segment - 1]) / span, 0.0, 1.0) : 0.0;
    resampled.push_back((1.0 - t) * line[segment - 1] + t * line[segment]);
  }
  return resampled;
}

/// A Gaussian along the line. Beyond its ends an open line is reflected in them, so that they stay.
PixelPath Smoothed(const PixelPath& line, bool closed) {
  const auto count = std::ssize(line);
  const int64_t reach = std::min<int64_t>(static_cast<int64_t>(std::ceil(3.0 * kSmoothing)), count - 1);
  const auto point_at = [&](int64_t i) -> Vector2d {
    // A closed line's last point is its first one again.
    if (closed) return line[(i + 2 * (count - 1)) % (count - 1)];
    if (i < 0) return 2.0 * line.front() - line[-i];
    if (i >= count) return 2.0 * line.back() - line[2 * (count - 1) - i];
    return line[i];
  };
  PixelPath smoothed;
  for (int64_t i = 0; i < count; ++i) {
    Vector2d sum = Vector2d::Zero();
    double total = 0.0;
    for (int64_t k = -reach; k <= reach; ++k) {
      const double distance = static_cast<double>(k) / kSmoothing;
      const double weight = std::exp(-0.5 * distance * distance);
      sum += weight * point_at(i + k);
      total += weight;
    }
    smoothed.push_back(sum / total);
  }
  return smoothed;
}

PixelPath Simplified(const PixelPath& line) {
  PixelPath simplified;
  for (const int i : ReducedLine(line, kSimplification)) simplified.push_back(line[size_t(i)]);
  return simplified;
}

}  // namespace

std::vector<Stroke> TraceSkeleton(const SkeletonGraph& graph) {
  std::vector<Stroke> strokes;
  for (const auto& [points, closed] : Tracer(graph).Trace()) {
    const PixelPath line = points.size() < 2 ? points : Simplified(Smoothed(Resampled(points), closed));
    Stroke stroke;
    for (const auto& point : line) {
      stroke.points.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace daumier::render
