#include "systems/sketch/session_curves.h"

#include "core/error.h"
#include "systems/sketch/loop_halves.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>

namespace daumier::sketch {
namespace {

constexpr double kSegmentLength = 20;
constexpr double kLeastStroke = 1;
constexpr const char* kKindOfSilhouette = "silhouette";

bool IsErased(const SessionCurve& curve, size_t point) {
  return curve.gap && point >= curve.gap->first && point <= curve.gap->last;
}

/// The segment of a feature curve, of about kSegmentLength, that holds a point.
CurveGap SegmentAt(const SessionCurve& curve, size_t point) {
  const auto count = std::max<size_t>(1, size_t(std::lround(datasets::LengthOf(curve.points) / kSegmentLength)));
  const size_t n = curve.points.size(), segment = std::min(count - 1, point * count / n);
  const auto begin = [&](size_t s) { return (s * n + count - 1) / count; };
  return {begin(segment), begin(segment + 1) - 1};
}

/// The end of a gap at a point, where the curve continues: its neighbour; else the erased point itself.
struct GapEnd {
  Eigen::Vector2d place;
  bool is_open;
};

GapEnd EndBefore(const SessionCurve& curve) {
  const size_t first = curve.gap->first;
  return first > 0 ? GapEnd{curve.points[first - 1], true} : GapEnd{curve.points[first], false};
}

GapEnd EndBehind(const SessionCurve& curve) {
  const size_t last = curve.gap->last;
  return last + 1 < curve.points.size() ? GapEnd{curve.points[last + 1], true} : GapEnd{curve.points[last], false};
}

bool IsErasedWhole(const SessionCurve& curve) {
  return curve.gap && curve.gap->first == 0 && curve.gap->last + 1 == curve.points.size();
}

/// Twice the area that a closed line runs around, by its sense.
double SignedArea(const CanvasPoints& loop) {
  double sum = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d &a = loop[i], &b = loop[(i + 1) % loop.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

/// Points at equal steps of a loop's length, the first not repeated at the end.
CanvasPoints ResampledLoop(CanvasPoints loop, int count) {
  loop.push_back(loop.front());
  CanvasPoints points = datasets::Resampled(loop, count + 1);
  points.pop_back();
  return points;
}

Eigen::Vector2d CentreOf(const CanvasPoints& points) {
  return std::accumulate(points.begin(), points.end(), Eigen::Vector2d(Eigen::Vector2d::Zero())) /
         double(points.size());
}

/// A stroke as a loop that runs as the curve does and begins where, of all places, the two about their centres differ
/// least.
CanvasPoints LoopLike(const SessionCurve& curve, CanvasPoints stroke) {
  constexpr int kPoints = 128;
  if ((SignedArea(stroke) < 0) != (SignedArea(curve.points) < 0)) std::ranges::reverse(stroke);
  CanvasPoints loop = ResampledLoop(std::move(stroke), kPoints);
  const CanvasPoints old = ResampledLoop({curve.points.begin(), curve.points.end() - 1}, kPoints);
  const Eigen::Vector2d shift = CentreOf(old) - CentreOf(loop);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < kPoints; ++start) {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i)
      sum += (loop[size_t((start + i) % kPoints)] + shift - old[size_t(i)]).squaredNorm();
    if (sum < least) least = sum, best = start;
  }
  std::rotate(loop.begin(), loop.begin() + best, loop.end());
  loop.push_back(loop.front());
  return loop;
}

/// How far a stroke's ends are from those of a gap: the larger of both distances; of a curve that is a loop, the least
/// distance from its beginning.
double EndDistance(const CanvasPoints& stroke, const SessionCurve& curve) {
  const std::optional<GapEnds> ends = EndsOfGap(curve);
  if (!ends) return datasets::DistanceTo(stroke, curve.points.front());
  return std::max((stroke.front() - ends->first).norm(), (stroke.back() - ends->last).norm());
}

/// The stroke with its ends on the open ends of the gap.
CanvasPoints Snapped(CanvasPoints stroke, const SessionCurve& curve) {
  const GapEnd before = EndBefore(curve), behind = EndBehind(curve);
  const Eigen::Vector2d at_start =
      before.is_open ? Eigen::Vector2d(before.place - stroke.front()) : Eigen::Vector2d(Eigen::Vector2d::Zero());
  const Eigen::Vector2d at_end =
      behind.is_open ? Eigen::Vector2d(behind.place - stroke.back()) : Eigen::Vector2d(Eigen::Vector2d::Zero());
  const std::vector<double> lengths = datasets::ArcLengths(stroke);
  for (size_t i = 0; i < stroke.size(); ++i) {
    const double share = lengths[i] / lengths.back();
    stroke[i] += (1 - share) * at_start + share * at_end;
  }
  return stroke;
}

/// The line on which the points of a gap are laid, with the widths of the drawn one, which runs from the gap's first end
/// to its last.
PenLine LaidOn(const SessionCurve& curve, const PenLine& drawn) {
  if (!curve.closed || !IsErasedWhole(curve)) return {Snapped(drawn.points, curve), drawn.widths};
  PenLine loop{LoopLike(curve, drawn.points)};
  if (drawn.widths.empty()) return loop;
  for (const Eigen::Vector2d& point : loop.points)
    loop.widths.push_back(WidthAtShare(drawn, datasets::ShareNearest(drawn.points, point)));
  return loop;
}

/// Lays the erased points on a stroke that runs from the gap's first end to its last.
void Fill(SessionCurve& curve, const PenLine& drawn) {
  const PenLine stroke = LaidOn(curve, drawn);
  const size_t first = curve.gap->first, last = curve.gap->last;
  const size_t from = EndBefore(curve).is_open ? first - 1 : first, to = EndBehind(curve).is_open ? last + 1 : last;
  const std::vector<double> old =
      datasets::ArcLengths({curve.points.begin() + ptrdiff_t(from), curve.points.begin() + ptrdiff_t(to) + 1});
  for (size_t i = first; i <= last; ++i) {
    const double share =
        old.back() > 0 ? old[i - from] / old.back() : double(i - from) / double(std::max<size_t>(1, to - from));
    curve.points[i] = datasets::AtShare(stroke.points, share);
    if (!curve.widths.empty() || !stroke.widths.empty()) {
      curve.widths.resize(curve.points.size(), 0);
      curve.widths[i] = WidthAtShare(stroke, share);
    }
  }
  curve.gap.reset();
}

/// Maps a curve by the similarity that takes a, b to new_a, new_b.
void MapByEnds(CanvasPoints& points, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& new_a,
               const Eigen::Vector2d& new_b) {
  using Complex = std::complex<double>;
  const auto complex = [](const Eigen::Vector2d& p) { return Complex(p.x(), p.y()); };
  const Complex from = complex(b) - complex(a);
  const Complex turn = std::abs(from) > 0 ? (complex(new_b) - complex(new_a)) / from : Complex(1);
  for (Eigen::Vector2d& point : points) {
    const Complex mapped = turn * (complex(point) - complex(a)) + complex(new_a);
    point = {mapped.real(), mapped.imag()};
  }
}

/// Moves points of a partner that have crossed the curve back to it, across the line from corner to corner; both run from
/// the same corner. Returns whether any was moved.
bool Uncross(CanvasPoints& partner, const SessionCurve& curve) {
  const Eigen::Vector2d along = curve.points.back() - curve.points.front();
  if (along.norm() == 0) return false;
  const double side = curve.name.starts_with("upper_") == (along.x() >= 0) ? 1 : -1;  // y is down.
  const Eigen::Vector2d away = side * Eigen::Vector2d(-along.y(), along.x()).normalized();
  const std::vector<double> lengths = datasets::ArcLengths(partner);
  bool is_moved = false;
  for (size_t i = 0; i < partner.size() && lengths.back() > 0; ++i) {
    const double gap = away.dot(partner[i] - datasets::AtShare(curve.points, lengths[i] / lengths.back()));
    if (gap >= 0) continue;
    partner[i] -= gap * away;
    is_moved = true;
  }
  return is_moved;
}

/// What an eraser comes nearest to.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  size_t line = 0, point = 0;
};

Nearest NearestCurve(const SessionLines& lines, const CanvasPoints& path) {
  Nearest nearest;
  for (size_t c = 0; c < lines.curves.size(); ++c) {
    const SessionCurve& curve = lines.curves[c];
    for (size_t i = 0; i < curve.points.size(); ++i) {
      if (IsErased(curve, i)) continue;
      if (const double distance = datasets::DistanceTo(path, curve.points[i]); distance < nearest.distance)
        nearest = {distance, c, i};
    }
  }
  return nearest;
}

/// Of a closed curve: without its beginning, unless nothing else is left.
CurveGap KeepingBeginning(const SessionCurve& curve, const CurveGap& gap) {
  const size_t n = curve.points.size();
  if (!curve.closed || n < 3) return gap;
  if (gap.first <= 1 && gap.last + 2 >= n) return {0, n - 1};
  return {std::max<size_t>(gap.first, 1), std::min(gap.last, n - 2)};
}

/// The points of the silhouette within the eraser's reach; at least the given one.
CurveGap WithinReach(const SessionCurve& curve, const CanvasPoints& path, size_t point) {
  CurveGap gap{point, point};
  for (size_t i = 0; i < curve.points.size(); ++i)
    if (datasets::DistanceTo(path, curve.points[i]) <= kEraserReach)
      gap = {std::min(gap.first, i), std::max(gap.last, i)};
  return gap;
}

}  // namespace

SessionLines LinesOf(const faces::FaceTemplate& face_template, const std::vector<std::string>& names,
                     const fitting::CurveOffsets& offsets, std::span<const float> points) {
  DAUMIER_CHECK(offsets.size() == names.size() + 1 && points.size() == 2 * size_t(offsets.back()),
                "{} curves of {} numbers for {} names", offsets.size() - 1, points.size(), names.size());
  SessionLines lines;
  for (size_t c = 0; c < names.size(); ++c) {
    const auto known = std::ranges::find(face_template.annotation.curves, names[c], &faces::FeatureCurve::name);
    DAUMIER_CHECK(known != face_template.annotation.curves.end(), "the template has no curve '{}'", names[c]);
    SessionCurve curve{names[c], known->kind, known->closed, {}};
    for (auto i = size_t(offsets[c]); i < size_t(offsets[c + 1]); ++i)
      curve.points.emplace_back(points[2 * i], points[2 * i + 1]);
    lines.curves.push_back(std::move(curve));
  }
  return lines;
}

std::string PartnerOf(const std::string& name) {
  constexpr std::string_view kUpper = "upper_", kLower = "lower_";
  if (name.starts_with(kUpper)) return std::string(kLower) + name.substr(kUpper.size());
  if (name.starts_with(kLower)) return std::string(kUpper) + name.substr(kLower.size());
  return "";
}

void CheckStroke(const CanvasPoints& stroke) {
  DAUMIER_CHECK(std::ranges::all_of(stroke, [](const Eigen::Vector2d& p) { return p.allFinite(); }),
                "a stroke has a point that is not finite");
  DAUMIER_CHECK(stroke.size() > 1 && datasets::ArcLengths(stroke).back() >= kLeastStroke,
                "a stroke is shorter than a pixel of the canvas");
}

bool Erase(SessionLines& lines, const CanvasPoints& path) {
  DAUMIER_CHECK(!path.empty(), "the eraser's path has no point");
  Nearest wrinkle;
  for (size_t w = 0; w < lines.wrinkles.size(); ++w)
    for (const Eigen::Vector2d& point : lines.wrinkles[w].points)
      if (const double distance = datasets::DistanceTo(path, point); distance < wrinkle.distance)
        wrinkle = {distance, w, 0};
  const Nearest curve = NearestCurve(lines, path);
  if (std::min(wrinkle.distance, curve.distance) > kEraserReach) return false;
  if (wrinkle.distance < curve.distance) {
    lines.wrinkles.erase(lines.wrinkles.begin() + ptrdiff_t(wrinkle.line));
    return true;
  }
  SessionCurve& erased = lines.curves[curve.line];
  CurveGap gap =
      erased.kind == kKindOfSilhouette ? WithinReach(erased, path, curve.point) : SegmentAt(erased, curve.point);
  if (erased.gap) gap = {std::min(gap.first, erased.gap->first), std::max(gap.last, erased.gap->last)};
  erased.gap = KeepingBeginning(erased, gap);
  return true;
}

std::optional<size_t> Draw(SessionLines& lines, const CanvasPoints& stroke, const std::vector<double>& widths) {
  CheckStroke(stroke);
  DAUMIER_CHECK(widths.empty() || widths.size() == stroke.size(), "{} widths of {} points", widths.size(),
                stroke.size());
  const PenLine forwards{stroke, widths}, backwards = Reversed(forwards);
  if (const auto loop = HalvesOfLoop(lines, forwards)) {
    for (const size_t c : loop->erased) lines.curves[c].gap = CurveGap{0, lines.curves[c].points.size() - 1};
    // Gaps that are equally near are filled in the order of the curves, in which upper lids and lips come first.
    const auto& [upper, lower] = loop->lines;
    Draw(lines, upper.points, upper.widths);
    return Draw(lines, lower.points, lower.widths);
  }
  std::optional<size_t> filled;
  const PenLine* direction = nullptr;
  double least = kSnapReach;
  for (size_t c = 0; c < lines.curves.size(); ++c) {
    if (!lines.curves[c].gap) continue;
    for (const PenLine* way : {&forwards, &backwards}) {
      const double distance = EndDistance(way->points, lines.curves[c]);
      if (distance > least || (filled && distance == least)) continue;
      least = distance, filled = c, direction = way;
    }
  }
  if (!filled) {
    lines.wrinkles.push_back(forwards);
    return std::nullopt;
  }
  SessionCurve& curve = lines.curves[*filled];
  const Eigen::Vector2d first = curve.points.front(), last = curve.points.back();
  Fill(curve, *direction);
  curve.drawn = ++lines.num_drawn;
  const auto partner = std::ranges::find(lines.curves, PartnerOf(curve.name), &SessionCurve::name);
  if (partner == lines.curves.end()) return filled;
  const bool ends_moved = first != curve.points.front() || last != curve.points.back();
  if (ends_moved) MapByEnds(partner->points, first, last, curve.points.front(), curve.points.back());
  if (Uncross(partner->points, curve) || ends_moved) partner->drawn = lines.num_drawn;
  return filled;
}

std::optional<GapEnds> EndsOfGap(const SessionCurve& curve) {
  if (!curve.gap || (curve.closed && IsErasedWhole(curve))) return std::nullopt;
  return GapEnds{EndBefore(curve).place, EndBehind(curve).place};
}

void KeepWidths(SessionLines& lines, const SessionLines& from) {
  for (SessionCurve& curve : lines.curves) {
    const auto known = std::ranges::find(from.curves, curve.name, &SessionCurve::name);
    if (known != from.curves.end()) curve.widths = known->widths;
  }
}

std::vector<render::WeightedStroke> WeightedStrokesOf(const SessionLines& lines) {
  std::vector<render::WeightedStroke> strokes;
  const auto add = [&](const PenLine& line, size_t first, size_t last) {
    if (last < first + 2) return;
    render::WeightedStroke& stroke = strokes.emplace_back();
    for (size_t i = first; i < last; ++i) {
      stroke.points.push_back({float(line.points[i].x()), float(line.points[i].y())});
      if (!line.widths.empty()) stroke.widths.push_back(float(line.widths[i]));
    }
  };
  for (const SessionCurve& curve : lines.curves) {
    const PenLine line{curve.points, curve.widths};
    add(line, 0, curve.gap ? curve.gap->first : line.points.size());
    if (curve.gap) add(line, curve.gap->last + 1, line.points.size());
  }
  for (const PenLine& wrinkle : lines.wrinkles) add(wrinkle, 0, wrinkle.points.size());
  return strokes;
}

std::vector<render::Stroke> StrokesOf(const SessionLines& lines) {
  const std::vector<render::WeightedStroke> strokes = WeightedStrokesOf(lines);
  return {strokes.begin(), strokes.end()};
}

}  // namespace daumier::sketch
