#include "render/swept_outline.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using Outline = std::vector<Vector2d>;

/// An arc of a circle about the origin, radius 30, from angle 0 on.
Outline ArcLine(double angle, int count = 200) {
  Outline line;
  for (int i = 0; i < count; ++i) {
    const double at = angle * i / (count - 1);
    line.emplace_back(30.0 * std::cos(at), 30.0 * std::sin(at));
  }
  return line;
}

/// One side of a line with butt ends, and back along the other.
Outline SweptRound(const Outline& line, const std::function<Vector2d(size_t)>& half_width_at) {
  Outline outline;
  for (size_t i = 0; i < line.size(); ++i) outline.push_back(line[i] + half_width_at(i));
  for (size_t i = line.size(); i-- > 0;) outline.push_back(line[i] - half_width_at(i));
  return outline;
}

/// A circle drawn more than once round with a pen of this width: the ends lie over each other.
Outline OverlappingRing(double width) {
  const Outline line = ArcLine(2.2 * pi);
  return SweptRound(line, [&](size_t i) { return Vector2d(0.5 * width * line[i].normalized()); });
}

double FarthestFrom(const Stroke& stroke, const std::function<double(double, double)>& distance) {
  double farthest = 0.0;
  for (const auto& [x, y] : stroke.points) farthest = std::max(farthest, std::abs(distance(x, y)));
  return farthest;
}

double FromCircle(double x, double y) {
  return std::hypot(x, y) - 30.0;
}

TEST(LineOfSweptOutline, GoesRoundACircleWhoseEndsLieOverEachOther) {
  const auto swept = LineOfSweptOutline(OverlappingRing(8.0));
  ASSERT_TRUE(swept.has_value());
  EXPECT_NEAR(swept->pen_width, 8.0, 0.3);
  EXPECT_NEAR(swept->width, 8.0, 0.3);
  EXPECT_NEAR(swept->length, 2.2 * pi * 30.0, 8.0);
  EXPECT_LT(FarthestFrom(swept->line, FromCircle), 0.5);
}

TEST(LineOfSweptOutline, DoesNotDependOnWhereTheOutlineBeginsNorOnItsSense) {
  Outline outline = OverlappingRing(8.0);
  std::rotate(outline.begin(), outline.begin() + 71, outline.end());
  std::reverse(outline.begin(), outline.end());
  const auto swept = LineOfSweptOutline(outline);
  ASSERT_TRUE(swept.has_value());
  EXPECT_NEAR(swept->length, 2.2 * pi * 30.0, 8.0);
  EXPECT_LT(FarthestFrom(swept->line, FromCircle), 0.5);
}

TEST(LineOfSweptOutline, FindsBothLidsOfAnEyeThatAWidePenFilled) {
  Outline line;
  for (int i = 0; i < 300; ++i)
    line.emplace_back(30.0 * std::cos(2.1 * pi * i / 299), 6.0 * std::sin(2.1 * pi * i / 299));
  const auto swept = LineOfSweptOutline(SweptRound(line, [&](size_t i) {
    const Vector2d along = line[std::min<size_t>(i + 1, 299)] - line[i > 0 ? i - 1 : 0];
    return Vector2d(6.0 * Vector2d(along.y(), -along.x()).normalized());
  }));
  ASSERT_TRUE(swept.has_value());
  double highest = 0.0, lowest = 0.0;
  for (const auto& [x, y] : swept->line.points) {
    if (std::abs(x) > 10.0) continue;
    EXPECT_NEAR(std::abs(y), 6.0 * std::sqrt(1.0 - x * x / 900.0), 1.0);
    highest = std::max<double>(highest, y);
    lowest = std::min<double>(lowest, y);
  }
  EXPECT_NEAR(highest, 6.0, 0.5);
  EXPECT_NEAR(lowest, -6.0, 0.5);
}

TEST(LineOfSweptOutline, PassesWhereABroadNibHasNoWidth) {
  // The nib points along x, as does the arc at its top.
  const Outline line = ArcLine(0.9 * pi);
  const auto swept = LineOfSweptOutline(SweptRound(line, [](size_t) { return Vector2d(2.0, 0.0); }));
  ASSERT_TRUE(swept.has_value());
  EXPECT_NEAR(swept->length, 0.9 * pi * 30.0, 5.0);
  EXPECT_LT(FarthestFrom(swept->line, FromCircle), 2.0);
}

TEST(LineOfSweptOutline, EndsAtTheCentreOfACapThatIsGoneRoundOneAndAHalfTimes) {
  Outline outline;
  for (int i = 0; i <= 100; ++i) outline.emplace_back(i, 5.0);
  for (int i = 1; i < 60; ++i) {
    const double angle = pi / 2 - 3.0 * pi * i / 60;
    outline.emplace_back(100.0 + 5.0 * std::cos(angle), 5.0 * std::sin(angle));
  }
  for (int i = 100; i >= 0; --i) outline.emplace_back(i, -5.0);
  const auto swept = LineOfSweptOutline(outline);
  ASSERT_TRUE(swept.has_value());
  double right = 0.0;
  for (const auto& [x, y] : swept->line.points) {
    right = std::max<double>(right, x);
    EXPECT_NEAR(y, 0.0, 2.6);
  }
  EXPECT_NEAR(right, 100.0, 3.0);
}

TEST(LineOfSweptOutline, AnOutlineThatNeitherCoversNorCrossesItselfHasNone) {
  const Outline line = ArcLine(1.5 * pi);
  EXPECT_FALSE(LineOfSweptOutline(SweptRound(line, [&](size_t i) { return Vector2d(4.0 * line[i].normalized()); })));
  EXPECT_FALSE(LineOfSweptOutline({}));
  EXPECT_FALSE(LineOfSweptOutline({{0, 0}, {1, 1}, {2, 2}, {0, 0}}));
}

TEST(LineOfSweptOutline, AStarIsNoLine) {
  Outline star;
  for (int i = 0; i < 5; ++i) star.emplace_back(std::sin(0.8 * pi * i), std::cos(0.8 * pi * i));
  EXPECT_FALSE(LineOfSweptOutline(star));
}

TEST(LineOfSweptOutline, RefusesWhatIsNotFinite) {
  EXPECT_THROW(LineOfSweptOutline({{0, 0}, {1, 0}, {1, std::numeric_limits<double>::quiet_NaN()}, {0, 1}}), Error);
}

}  // namespace
}  // namespace daumier::render
