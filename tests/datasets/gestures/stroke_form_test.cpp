#include "datasets/gestures/stroke_form.h"

#include "datasets/gestures/path_pen.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::datasets {
namespace {

using std::numbers::pi;

TEST(StrokeForm, OfALineARingAndTwoLoops) {
  const StrokeForm line = FormOf({{0, 0}, {3, 4}});
  EXPECT_NEAR(line.length, 5, 1e-12);
  EXPECT_NEAR(line.gap, 1, 1e-12);
  EXPECT_NEAR(line.deviation, 0, 1e-12);
  EXPECT_NEAR(line.turns, 0, 1e-9);
  EXPECT_NEAR(line.direction, std::atan2(4, 3), 1e-12);
  EXPECT_TRUE(line.is_nearly_straight());

  const StrokeForm ring = FormOf(PathPen().Arc(2 * pi, 1).points());
  EXPECT_LT(ring.gap, 1e-6);
  EXPECT_NEAR(ring.turns, 1, 0.05);
  EXPECT_TRUE(ring.is_nearly_closed());
  EXPECT_FALSE(ring.is_nearly_straight());

  const Polyline loops = PathPen().Forward(2).Arc(-2 * pi, 0.5).Forward(1).Arc(-2 * pi, 0.5).Forward(2).points();
  EXPECT_NEAR(FormOf(loops).turns, -2, 0.05);
  EXPECT_NEAR(FormOf(Reversed(loops)).turns, 2, 0.05);
}

TEST(StrokeForm, AHalfRingDeviatesByHalfItsChord) {
  const StrokeForm half = FormOf(PathPen().Arc(pi, 2).points());
  EXPECT_NEAR(half.deviation, 0.5, 1e-3);
  EXPECT_NEAR(half.gap, 2 / pi, 1e-3);
}

TEST(StrokeForm, DependsOnNeitherPlaceNorSize) {
  const Polyline line = PathPen().Forward(1).Arc(2, 0.4).Forward(0.3).points();
  Polyline other;
  for (const auto& point : line) other.push_back(70 * point + Eigen::Vector2d(300, -20));
  EXPECT_NEAR(FormOf(line).gap, FormOf(other).gap, 1e-9);
  EXPECT_NEAR(FormOf(line).turns, FormOf(other).turns, 1e-9);
  EXPECT_NEAR(FormOf(line).deviation, FormOf(other).deviation, 1e-9);
}

TEST(StrokeForm, RefusesAStrokeWithoutLength) {
  testing::ExpectError([] { FormOf({{1, 1}, {1, 1}}); }, "without length");
}

TEST(Smoothed, KeepsTheEndsAndStraightLines) {
  const Polyline smooth = Smoothed({{0, 0}, {4, 0}, {4, 4}}, 0.2, 41);
  EXPECT_EQ(smooth.size(), 41u);
  EXPECT_EQ(smooth.front(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(smooth.back(), Eigen::Vector2d(4, 4));
  EXPECT_NEAR(smooth[10].y(), 0, 1e-12);
  EXPECT_GT((smooth[20] - Eigen::Vector2d(4, 0)).norm(), 0.1) << "the corner is rounded";
}

TEST(MayBeGesture, OfLinesRingsSlantedRollsAndLevelShafts) {
  EXPECT_TRUE(MayBeGesture({{0, 0}, {1, 0.05}, {2, 0}}));
  EXPECT_TRUE(MayBeGesture(PathPen().Arc(1.9 * pi, 1).points()));
  EXPECT_TRUE(MayBeGesture(PathPen(0.7).Forward(2).Arc(2 * pi, 0.5).Forward(2).points()));
  EXPECT_TRUE(MayBeGesture({{0, 0}, {4, 0}, {3.2, 0.8}}));
  EXPECT_FALSE(MayBeGesture(PathPen().Arc(pi, 1).points()));
  EXPECT_FALSE(MayBeGesture({{0, 0}, {1, 2}, {2, 0}, {3, 2}, {4, 0}}));
}

}  // namespace
}  // namespace daumier::datasets
