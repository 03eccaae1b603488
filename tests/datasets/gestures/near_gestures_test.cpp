#include "datasets/gestures/near_gestures.h"

#include "datasets/gestures/stroke_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

constexpr int kNumMisses = 150;

/// Full turns of its direction, point by point.
double TurnsOf(const Polyline& line) {
  double angle = 0;
  for (size_t i = 2; i < line.size(); ++i) {
    const Eigen::Vector2d a = line[i - 1] - line[i - 2], b = line[i] - line[i - 1];
    if (a.isZero(0) || b.isZero(0)) continue;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return angle / (2 * std::numbers::pi);
}

TEST(ManyLoops, TurnAtLeastFourTimes) {
  Rng rng(1);
  for (int i = 0; i < kNumMisses; ++i) EXPECT_GT(std::abs(TurnsOf(ManyLoops(rng))), 3.6);
}

TEST(LevelLoops, LieAlongALevelOrAnUprightLine) {
  Rng rng(2);
  for (int i = 0; i < kNumMisses; ++i) {
    const Polyline line = LevelLoops(rng);
    const Eigen::Vector2d way = (line.back() - line.front()).cwiseAbs();
    EXPECT_LT(way.minCoeff(), 0.13 * way.maxCoeff());
  }
}

TEST(MixedLoops, DoNotTurnAsOftenAsTheyHaveLoops) {
  Rng rng(3);
  for (int i = 0; i < kNumMisses; ++i) {
    const double turns = std::abs(FormOf(MixedLoops(rng)).turns);
    EXPECT_LT(std::min(std::abs(turns - std::round(turns)), 1.0), 0.5);
    EXPECT_LT(turns, 2.2);
  }
}

TEST(TurnedArrow, IsHigherThanAnArrowMayTilt) {
  Rng rng(4);
  for (int i = 0; i < kNumMisses; ++i) {
    const Eigen::AlignedBox2d box = BoxOf(TurnedArrow(rng));
    EXPECT_GT(box.sizes().y(), 0.6 * box.sizes().x());
  }
}

TEST(DoubleArrow, HasHooksAtBothEnds) {
  Rng rng(5);
  for (int i = 0; i < kNumMisses; ++i) {
    const StrokeForm form = FormOf(DoubleArrow(rng));
    EXPECT_GT(form.length, 1.2) << "a shaft of 1 and two barbs";
  }
}

TEST(BrokenArrow, BeginsInAnotherDirectionThanTheArrow) {
  Rng rng(6);
  for (int i = 0; i < kNumMisses; ++i) EXPECT_LT(FormOf(BrokenArrow(rng)).gap, 0.93);
}

TEST(TailedRegion, HasItsEndsApart) {
  Rng rng(7);
  for (int i = 0; i < kNumMisses; ++i) EXPECT_GT(LengthOf(TailedRegion(rng)), 0);
}

}  // namespace
}  // namespace daumier::datasets
