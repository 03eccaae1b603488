#include "datasets/styles/polylines.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

Vector2d AtArc(const Polyline& line, const std::vector<double>& arcs, double arc) {
  const auto next = std::upper_bound(arcs.begin(), arcs.end(), arc);
  if (next == arcs.begin()) return line.front();
  if (next == arcs.end()) return line.back();
  const auto i = static_cast<size_t>(next - arcs.begin());
  return line[i - 1] + (arc - arcs[i - 1]) / (arcs[i] - arcs[i - 1]) * (line[i] - line[i - 1]);
}

/// The share of the segment from a to b at which it is nearest to a point, 0 to 1.
double ShareOnSegment(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  const Vector2d d = b - a;
  const double square = d.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(d) / square, 0.0, 1.0) : 0.0;
}

struct NearestPlace {
  size_t segment = 0;
  double share = 0, square = 1e300;
};

NearestPlace FindNearest(const Polyline& line, const Vector2d& point) {
  DAUMIER_CHECK(!line.empty(), "the nearest place on a line without points");
  NearestPlace best;
  best.square = (line.front() - point).squaredNorm();
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double share = ShareOnSegment(line[i], line[i + 1], point);
    const double square = (line[i] + share * (line[i + 1] - line[i]) - point).squaredNorm();
    if (square < best.square) best = {i, share, square};
  }
  return best;
}

/// Crossings of a segment with a polygon, as shares of the segment, ascending.
std::vector<double> Crossings(const Vector2d& a, const Vector2d& b, const Polyline& polygon) {
  std::vector<double> shares;
  const Vector2d d = b - a;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d e = polygon[i] - polygon[j];
    const double cross = d.x() * e.y() - d.y() * e.x();
    if (std::abs(cross) < 1e-12) continue;
    const Vector2d f = polygon[j] - a;
    const double along = (f.x() * e.y() - f.y() * e.x()) / cross, across = (f.x() * d.y() - f.y() * d.x()) / cross;
    if (along > 0 && along < 1 && across >= 0 && across < 1) shares.push_back(along);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

enum class Side { kInside, kOutside };

std::vector<LinePiece> PiecesOn(Side side, const Polyline& line, const Polyline& polygon) {
  std::vector<LinePiece> pieces;
  if (line.empty()) return pieces;
  Eigen::AlignedBox2d polygon_box = BoxOf(polygon), line_box = BoxOf(line);
  if (polygon.size() < 3 || !polygon_box.intersects(line_box)) {
    if (side == Side::kInside) return pieces;
    LinePiece whole{line, {}};
    for (size_t i = 0; i < line.size(); ++i) whole.origin.push_back(static_cast<int>(i));
    return {whole};
  }
  const auto counts = [&](const Vector2d& point) { return IsInside(polygon, point) == (side == Side::kInside); };
  bool is_on = counts(line.front());
  LinePiece piece;
  const auto add = [&](const Vector2d& point, int origin) {
    piece.points.push_back(point);
    piece.origin.push_back(origin);
  };
  const auto finish = [&] {
    if (piece.points.size() > 1 || (piece.points.size() == 1 && line.size() == 1)) pieces.push_back(piece);
    piece = {};
  };
  if (is_on) add(line.front(), 0);
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    for (const double share : Crossings(line[i], line[i + 1], polygon)) {
      add(line[i] + share * (line[i + 1] - line[i]), -1);
      if (is_on) finish();
      is_on = !is_on;
    }
    // The test of the point itself settles crossings that graze a corner.
    const bool is_next_on = counts(line[i + 1]);
    if (is_next_on != is_on) {
      if (is_on) finish();
      piece = {};
      is_on = is_next_on;
    }
    if (is_on) add(line[i + 1], static_cast<int>(i + 1));
  }
  finish();
  return pieces;
}

}  // namespace

std::vector<double> ArcLengths(const Polyline& line) {
  std::vector<double> lengths(line.size(), 0);
  for (size_t i = 1; i < line.size(); ++i) lengths[i] = lengths[i - 1] + (line[i] - line[i - 1]).norm();
  return lengths;
}

double LengthOf(const Polyline& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

Eigen::AlignedBox2d BoxOf(const Polyline& line) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : line) box.extend(point);
  return box;
}

Polyline Reversed(Polyline line) {
  std::reverse(line.begin(), line.end());
  return line;
}

Polyline Joined(Polyline first, const Polyline& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Polyline Part(const Polyline& line, double from, double to, int count) {
  DAUMIER_CHECK(!line.empty() && count >= 2, "{} points of a line of {}", count, line.size());
  const std::vector<double> arcs = ArcLengths(line);
  Polyline part;
  part.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    part.push_back(AtArc(line, arcs, arcs.back() * (from + (to - from) * i / (count - 1))));
  return part;
}

Polyline Resampled(const Polyline& line, int count) {
  return Part(line, 0, 1, count);
}

double ShareNearest(const Polyline& line, const Vector2d& point) {
  const NearestPlace place = FindNearest(line, point);
  const std::vector<double> arcs = ArcLengths(line);
  if (arcs.back() == 0) return 0;
  const size_t next = std::min(place.segment + 1, line.size() - 1);
  return (arcs[place.segment] + place.share * (arcs[next] - arcs[place.segment])) / arcs.back();
}

Vector2d AtShare(const Polyline& line, double share) {
  DAUMIER_CHECK(!line.empty(), "a point of a line without points");
  const std::vector<double> arcs = ArcLengths(line);
  return AtArc(line, arcs, arcs.back() * share);
}

int NearestIndex(const Polyline& line, const Vector2d& point) {
  DAUMIER_CHECK(!line.empty(), "the nearest point of a line without points");
  const auto nearer = [&](const Vector2d& a, const Vector2d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<int>(std::min_element(line.begin(), line.end(), nearer) - line.begin());
}

double DistanceTo(const Polyline& line, const Vector2d& point) {
  return std::sqrt(FindNearest(line, point).square);
}

Polyline Mixed(const Polyline& a, const Polyline& b, double t) {
  DAUMIER_CHECK(a.size() == b.size(), "lines of {} and {} points are mixed, expected the same number", a.size(),
                b.size());
  Polyline mixed(a.size());
  for (size_t i = 0; i < a.size(); ++i) mixed[i] = (1 - t) * a[i] + t * b[i];
  return mixed;
}

Polyline Smooth(const Polyline& through, int count) {
  if (through.size() < 3) return Resampled(through, count);
  constexpr int kPerSpan = 8;
  Polyline dense;
  const auto at = [&](ptrdiff_t i) {
    return through[size_t(std::clamp<ptrdiff_t>(i, 0, ptrdiff_t(through.size()) - 1))];
  };
  for (size_t span = 0; span + 1 < through.size(); ++span) {
    const auto s = static_cast<ptrdiff_t>(span);
    const Vector2d p0 = at(s - 1), p1 = at(s), p2 = at(s + 1), p3 = at(s + 2);
    for (int k = 0; k < kPerSpan; ++k) {
      const double t = double(k) / kPerSpan;
      dense.push_back(0.5 * (2 * p1 + t * (p2 - p0) + t * t * (2 * p0 - 5 * p1 + 4 * p2 - p3) +
                             t * t * t * (3 * p1 - p0 - 3 * p2 + p3)));
    }
  }
  dense.push_back(through.back());
  return Resampled(dense, count);
}

Polyline EllipseArc(const Vector2d& centre, double half_x, double half_y, double from, double to, int count) {
  Polyline arc;
  for (int i = 0; i < count; ++i) {
    const double angle = (from + (to - from) * i / (count - 1)) * std::numbers::pi / 180;
    arc.push_back(centre + Vector2d(half_x * std::cos(angle), half_y * std::sin(angle)));
  }
  return arc;
}

bool IsInside(const Polyline& polygon, const Vector2d& point) {
  bool is_inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) is_inside = !is_inside;
  }
  return is_inside;
}

std::vector<LinePiece> Outside(const Polyline& line, const Polyline& polygon) {
  return PiecesOn(Side::kOutside, line, polygon);
}

std::vector<LinePiece> Inside(const Polyline& line, const Polyline& polygon) {
  return PiecesOn(Side::kInside, line, polygon);
}

Polyline Waved(const Polyline& line, double amplitude, double waves, double phase) {
  if (line.size() < 2) return line;
  const std::vector<double> arcs = ArcLengths(line);
  Polyline waved = line;
  for (size_t i = 0; i < line.size(); ++i) {
    const Vector2d along = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    if (along.squaredNorm() == 0 || arcs.back() == 0) continue;
    const Vector2d normal = Vector2d(along.y(), -along.x()).normalized();
    waved[i] += amplitude * std::sin(2 * std::numbers::pi * (waves * arcs[i] / arcs.back() + phase)) * normal;
  }
  return waved;
}

double Deviate(double deviation, Rng& rng) {
  return deviation * std::clamp(rng.Normal(), -2.0, 2.0);
}

}  // namespace daumier::datasets
