#include "systems/sketch/loop_halves.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace daumier::sketch {
namespace {

constexpr double kSameEnds = 1;  // Pixels of the canvas.

Eigen::Vector2d MiddleOf(const CanvasPoints& points) {
  return std::accumulate(points.begin(), points.end(), Eigen::Vector2d(Eigen::Vector2d::Zero())) /
         double(points.size());
}

bool HaveSameEnds(const GapEnds& a, const GapEnds& b) {
  const auto is_same = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return (p - q).norm() < kSameEnds; };
  return (is_same(a.first, b.first) && is_same(a.last, b.last)) ||
         (is_same(a.first, b.last) && is_same(a.last, b.first));
}

/// Where a stroke is divided, and what is erased for it.
struct LoopPlace {
  GapEnds ends;
  std::vector<size_t> erased = {};
};

Eigen::Vector2d MiddleOf(const GapEnds& ends) {
  return (ends.first + ends.last) / 2;
}

/// The ends that two gaps share, nearest to a place.
std::optional<GapEnds> SharedGap(const SessionLines& lines, const Eigen::Vector2d& place) {
  std::vector<GapEnds> gaps;
  for (const SessionCurve& curve : lines.curves)
    if (const std::optional<GapEnds> ends = EndsOfGap(curve)) gaps.push_back(*ends);
  std::optional<GapEnds> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < gaps.size(); ++i)
    for (size_t k = i + 1; k < gaps.size(); ++k) {
      const double distance = (MiddleOf(gaps[i]) - place).norm();
      if (distance >= least || !HaveSameEnds(gaps[i], gaps[k])) continue;
      least = distance, nearest = gaps[i];
    }
  return nearest;
}

/// A curve with a gap and its partner, about which the stroke runs.
std::optional<LoopPlace> OpenPair(const SessionLines& lines, const CanvasPoints& stroke) {
  std::optional<LoopPlace> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (size_t c = 0; c < lines.curves.size(); ++c) {
    const SessionCurve& curve = lines.curves[c];
    const auto partner = std::ranges::find(lines.curves, PartnerOf(curve.name), &SessionCurve::name);
    if (!curve.gap || curve.points.size() < 3 || partner == lines.curves.end() || partner->points.size() < 3) continue;
    const GapEnds ends{curve.points.front(), curve.points.back()};
    if (!HaveSameEnds(ends, {partner->points.front(), partner->points.back()})) continue;
    const double length = (ends.last - ends.first).norm(), distance = (MiddleOf(ends) - MiddleOf(stroke)).norm();
    const auto along = [&](const Eigen::Vector2d& p) { return p.dot(ends.last - ends.first); };
    const auto [first, last] = std::ranges::minmax(stroke, {}, along);
    const bool is_around = distance <= length / 2 && along(last - first) >= kLeastLoop * length * length;
    if (distance >= least || !is_around) continue;
    least = distance;
    nearest = {ends, {c, size_t(partner - lines.curves.begin())}};
  }
  return nearest;
}

std::optional<LoopPlace> PlaceOf(const SessionLines& lines, const CanvasPoints& stroke) {
  if (const std::optional<GapEnds> gap = SharedGap(lines, MiddleOf(stroke))) return LoopPlace{*gap};
  return OpenPair(lines, stroke);
}

PenLine PartOf(const PenLine& line, size_t first, size_t last) {
  PenLine part;
  for (size_t i = first; i <= last; ++i) {
    part.points.push_back(line.points[i]);
    if (!line.widths.empty()) part.widths.push_back(line.widths[i]);
  }
  return part;
}

}  // namespace

std::optional<LoopHalves> HalvesOfLoop(const SessionLines& lines, const PenLine& stroke) {
  const CanvasPoints& points = stroke.points;
  if ((points.front() - points.back()).norm() > kOpenLoop * datasets::LengthOf(points)) return std::nullopt;
  const std::optional<LoopPlace> place = PlaceOf(lines, points);
  if (!place) return std::nullopt;
  const Eigen::Vector2d along = place->ends.last - place->ends.first;
  const auto is_before = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.dot(along) < q.dot(along);
  };
  const auto [least, greatest] = std::ranges::minmax_element(points, is_before);
  const auto from = size_t(std::min(least, greatest) - points.begin());
  const auto to = size_t(std::max(least, greatest) - points.begin());
  if (to - from < 2 || points.size() - to + from < 2) return std::nullopt;
  std::array<PenLine, 2> halves{PartOf(stroke, from, to),
                                Joined(PartOf(stroke, to, points.size() - 1), PartOf(stroke, 0, from))};
  if (MiddleOf(halves[1].points).y() < MiddleOf(halves[0].points).y()) std::swap(halves[0], halves[1]);
  return LoopHalves{std::move(halves), place->erased};
}

}  // namespace daumier::sketch
