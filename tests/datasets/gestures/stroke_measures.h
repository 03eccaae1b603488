#pragma once
#include "datasets/gestures/gesture.h"
#include "datasets/styles/polylines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// The definitions of `gesture.h` as measures of a stroke.
namespace daumier::datasets {

/// Counter-clockwise from a to b on the sheet, degrees.
inline double DegreesBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return -std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * 180 / std::numbers::pi;
}

/// The largest distance of a line from its chord as a share of the chord.
inline double BowOf(const Polyline& line) {
  double most = 0;
  for (const Eigen::Vector2d& point : line) most = std::max(most, DistanceTo({line.front(), line.back()}, point));
  return most / std::max((line.back() - line.front()).norm(), 1e-9);
}

struct StrokeMeasures {
  double turns = 0;        ///< Full turns of its direction, without a tick at either end, absolute.
  double sharpest = 0;     ///< The largest turn within three of its 128 points, degrees.
  int num_crossings = 0;   ///< Of the stroke with itself.
  double gap = 0;          ///< From end to end, share of its length.
  double rise = 0;         ///< Direction from its first point to its last, degrees counter-clockwise from the right.
  double bow = 0;          ///< `BowOf`.
  double span = 0;         ///< Its extent in the direction of the chord, as a multiple of the chord.
  double area = 0;         ///< Of the closed polygon, 4 pi area / length^2: 1 of a circle.
  double width_share = 0;  ///< Of the width and height of its box.
  double extent = 0;       ///< The larger side of its box.
  bool points_left = false, points_right = false;  ///< `StartsWithShaft`, from either of its ends.
};

/// Whether the stroke starts with a straight, flat shaft that leads to the side (1: right) on which most of its ink is;
/// the rest returns from there.
inline bool StartsWithShaft(const Polyline& line, double side) {
  const Polyline shaft = Part(line, 0.03, 0.42, 30);
  const Eigen::Vector2d way = shaft.back() - shaft.front();
  if (side * way.x() <= 0 || std::abs(way.y()) > 0.45 * std::abs(way.x()) || BowOf(shaft) > 0.1) return false;
  const Eigen::AlignedBox2d box = BoxOf(line);
  double ink = 0, most_degrees = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d step = line[i + 1] - line[i];
    if (side * (line[i].x() - box.center().x()) > 0) ink += step.norm();
    if (i > line.size() / 2) most_degrees = std::max(most_degrees, std::abs(DegreesBetween(way, step)));
  }
  const double width = box.sizes().x(), far = side > 0 ? box.max().x() : box.min().x();
  return ink > 0.515 * LengthOf(line) && most_degrees > 106 &&
         std::abs(line.front().x() - box.center().x()) > 0.4 * width && std::abs(line.back().x() - far) > 0.02 * width;
}

inline int CrossingsOf(const Polyline& line) {
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
    return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() > 0;
  };
  int count = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    for (size_t j = i + 2; j + 1 < line.size(); ++j) {
      if (side(line[i], line[i + 1], line[j]) != side(line[i], line[i + 1], line[j + 1]) &&
          side(line[j], line[j + 1], line[i]) != side(line[j], line[j + 1], line[i + 1])) {
        ++count;
      }
    }
  }
  return count;
}

/// Of 128 points at equal distances, smoothed over three.
inline StrokeMeasures MeasureStroke(const Polyline& stroke) {
  const Polyline raw = Resampled(stroke, 128);
  Polyline line = raw;
  for (size_t i = 1; i + 1 < raw.size(); ++i) line[i] = (raw[i - 1] + raw[i] + raw[i + 1]) / 3;
  StrokeMeasures measures;
  const double length = std::max(LengthOf(line), 1e-9);
  const Eigen::Vector2d chord = line.back() - line.front();
  double turning = 0, twice_area = 0, low = 1e9, high = -1e9;
  for (size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d& next = line[(i + 1) % line.size()];
    twice_area += line[i].x() * next.y() - line[i].y() * next.x();
    low = std::min(low, line[i].dot(chord));
    high = std::max(high, line[i].dot(chord));
    if (i > 5 && i + 6 < line.size()) {
      turning += DegreesBetween(line[i] - line[i - 1], next - line[i]);
      const double turn = std::abs(DegreesBetween(line[i - 1] - line[i - 2], line[i + 2] - line[i + 1]));
      measures.sharpest = std::max(measures.sharpest, turn);
    }
  }
  measures.turns = std::abs(turning) / 360;
  measures.num_crossings = CrossingsOf(line);
  measures.gap = chord.norm() / length;
  measures.rise = DegreesBetween({1, 0}, chord);
  measures.bow = BowOf(line);
  measures.span = (high - low) / std::max(chord.squaredNorm(), 1e-9);
  measures.area = 2 * std::numbers::pi * std::abs(twice_area) / (length * length);
  const Eigen::Vector2d sizes = BoxOf(line).sizes();
  measures.width_share = sizes.x() / std::max(sizes.sum(), 1e-9);
  measures.extent = sizes.maxCoeff();
  measures.points_right = StartsWithShaft(line, 1) || StartsWithShaft(Reversed(line), 1);
  measures.points_left = StartsWithShaft(line, -1) || StartsWithShaft(Reversed(line), -1);
  return measures;
}

/// The classes whose definition a stroke of a readable size fulfils.
inline std::vector<Gesture> GesturesByDefinition(const Polyline& stroke) {
  const StrokeMeasures m = MeasureStroke(stroke);
  std::vector<Gesture> gestures;
  if (m.extent < 20) return gestures;
  if (m.bow < 0.08 && m.gap > 0.85) gestures.push_back(Gesture::kLine);
  if (m.gap < 0.14 && m.area > 0.45 && m.turns < 1.45) gestures.push_back(Gesture::kRegion);
  if (m.width_share > 0.565 && m.gap > 0.2 && m.bow > 0.05 && m.area < 1.25) {
    if (m.points_left) gestures.push_back(Gesture::kLeftArrow);
    if (m.points_right) gestures.push_back(Gesture::kRightArrow);
  }
  for (int n = 1; n <= 3; ++n) {
    if (std::abs(m.turns - n) > 0.35 || m.gap < 0.1 || m.span > 1.9 || m.num_crossings < n) continue;
    if (m.sharpest > (n == 1 ? 100 : 140) || (n == 1 && m.num_crossings > 3)) continue;
    const Gesture first = m.rise > 0 ? Gesture::kUpRoll1 : Gesture::kDownRoll1;
    if (std::abs(m.rise) < 10 || std::abs(m.rise) > 80) continue;
    gestures.push_back(static_cast<Gesture>(static_cast<int>(first) + n - 1));
  }
  return gestures;
}

}  // namespace daumier::datasets
