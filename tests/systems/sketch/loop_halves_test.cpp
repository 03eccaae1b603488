#include "systems/sketch/loop_halves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::sketch {
namespace {

SessionCurve Lid(const char* name, double height, bool is_erased) {
  SessionCurve lid{name, name, false, {}};
  for (int i = 0; i <= 12; ++i) {
    const double t = i / 12.0;
    lid.points.emplace_back(100 + 60 * t, 100 - 4 * height * t * (1 - t));
  }
  if (is_erased) lid.gap = CurveGap{1, 11};
  return lid;
}

/// Lids from (100, 100) to (160, 100), of which the upper one is erased.
SessionLines Eye(bool is_lower_erased = true) {
  SessionLines lines;
  lines.curves = {Lid("upper_eye_left", 8, true), Lid("lower_eye_left", -5, is_lower_erased)};
  return lines;
}

/// An ellipse about the eye with corners at x = 98 and 162, begun at an angle.
PenLine Ellipse(double begin, double sense = 1, double share = 1) {
  PenLine line;
  constexpr int kPoints = 48;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = begin + sense * share * 2 * M_PI * i / kPoints;
    line.points.emplace_back(130 + 32 * std::cos(angle), 100 + 14 * std::sin(angle));
    line.widths.push_back(i);
  }
  return line;
}

TEST(LoopHalves, AreTheUpperAndTheLowerPartFromCornerToCorner) {
  for (const double begin : {0.0, 1.0, M_PI, 5.0})
    for (const double sense : {1.0, -1.0}) {
      const PenLine loop = Ellipse(begin, sense);
      const auto halves = HalvesOfLoop(Eye(), loop);
      ASSERT_TRUE(halves.has_value()) << begin;
      EXPECT_TRUE(halves->erased.empty());
      for (const PenLine& half : halves->lines) {
        EXPECT_EQ(half.points.size(), half.widths.size());
        EXPECT_NEAR(std::min(half.points.front().x(), half.points.back().x()), 98, 0.6) << begin;
        EXPECT_NEAR(std::max(half.points.front().x(), half.points.back().x()), 162, 0.6) << begin;
      }
      for (const Eigen::Vector2d& point : halves->lines[0].points) EXPECT_LT(point.y(), 105) << begin;
      for (const Eigen::Vector2d& point : halves->lines[1].points) EXPECT_GT(point.y(), 95) << begin;
      EXPECT_GE(halves->lines[0].points.size() + halves->lines[1].points.size(), loop.points.size());
    }
}

TEST(LoopHalves, NeedAClosedStrokeAroundTwoLinesWithTheSameEnds) {
  EXPECT_FALSE(HalvesOfLoop(Eye(), Ellipse(0, 1, 0.6)).has_value()) << "an arc";
  PenLine far = Ellipse(0), small = Ellipse(0);
  for (Eigen::Vector2d& point : far.points) point.y() += 40;
  for (Eigen::Vector2d& point : small.points)
    point = Eigen::Vector2d(130, 100) + 0.4 * (point - Eigen::Vector2d(130, 100));
  EXPECT_FALSE(HalvesOfLoop(Eye(false), far).has_value()) << "a loop elsewhere";
  EXPECT_FALSE(HalvesOfLoop(Eye(false), small).has_value()) << "a mole";
  SessionLines whole = Eye(false);
  whole.curves[0].gap.reset();
  EXPECT_FALSE(HalvesOfLoop(whole, Ellipse(0)).has_value()) << "no gap";
  SessionLines apart = Eye();
  for (Eigen::Vector2d& point : apart.curves[1].points) point.y() += 20;
  EXPECT_FALSE(HalvesOfLoop(apart, Ellipse(0)).has_value()) << "other ends";
}

TEST(LoopHalves, FillBothLidsInOneStrokeAlsoWhereOneIsErased) {
  for (const bool is_lower_erased : {true, false}) {
    SessionLines lines = Eye(is_lower_erased);
    EXPECT_EQ(Draw(lines, Ellipse(1.0).points), std::optional<size_t>(1));
    EXPECT_TRUE(lines.wrinkles.empty());
    EXPECT_FALSE(lines.curves[0].gap.has_value() || lines.curves[1].gap.has_value());
    EXPECT_NEAR(lines.curves[0].points[6].y(), 86, 0.7);
    EXPECT_NEAR(lines.curves[1].points[6].y(), 114, 0.7);
    const double corner =
        is_lower_erased ? 100 : 98;  // The ends of gaps stay; an eye that is drawn whole has its own corners.
    for (const SessionCurve& curve : lines.curves) EXPECT_NEAR(curve.points.front().x(), corner, 0.6);
  }
}

}  // namespace
}  // namespace daumier::sketch
