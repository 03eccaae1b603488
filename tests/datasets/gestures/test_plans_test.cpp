#include "datasets/gestures/test_plans.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

Polyline AimedPoints(const PenPlan& plan) {
  Polyline points;
  for (const ViaPoint& via : plan) points.push_back(via.at);
  return points;
}

TEST(TestPlans, FittedAndTurned) {
  const PenPlan plan = {{{0, 0}}, {{4, 0}, true}, {{4, 2}}};
  EXPECT_EQ(AimedPoints(FittedPlan(plan, 40)), (Polyline{{-20, -10}, {20, -10}, {20, 10}}));
  // Counter-clockwise on the sheet: the right becomes the top.
  EXPECT_TRUE(TurnedPlan(plan, 90)[1].at.isApprox(Vector2d(0, -4)));
  EXPECT_TRUE(TurnedPlan(plan, 90)[1].corner);
}

TEST(TestPlans, LogUniformHasAsManySmallNumbersAsLargeOnes) {
  Rng rng(1);
  int num_small = 0;
  for (int i = 0; i < 1000; ++i) {
    const double number = DrawLogUniform(10, 1000, rng);
    EXPECT_GE(number, 10);
    EXPECT_LE(number, 1000);
    num_small += number < 100 ? 1 : 0;
  }
  EXPECT_NEAR(num_small, 500, 60);
}

TEST(TestPlans, ALineIsStraight) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const Polyline line = AimedPoints(PlanTestLine(rng));
    const double chord = (line.back() - line.front()).norm();
    EXPECT_GT(chord, 44);
    for (const Vector2d& point : line) EXPECT_LT(DistanceTo({line.front(), line.back()}, point), 0.03 * chord);
  }
}

TEST(TestPlans, TheEndsOfARegionAreNear) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const Polyline line = AimedPoints(PlanTestRegion(rng));
    EXPECT_TRUE(IsInside(line, BoxOf(line).center())) << seed;
    EXPECT_LT((line.back() - line.front()).norm(), 0.145 * LengthOf(line)) << seed;
  }
}

TEST(TestPlans, AnArrowHasItsHeadInItsDirection) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const Polyline line = AimedPoints(PlanTestArrow(180, rng));
    const bool is_reversed = line.front().x() < line.back().x();
    const Vector2d tail = is_reversed ? line.back() : line.front();
    EXPECT_NEAR(tail.x(), BoxOf(line).max().x(), 1e-9);
    // The tip, which is the other end of the shaft, is the leftmost point.
    EXPECT_NEAR(BoxOf(line).min().x(), tail.x() - BoxOf(line).sizes().x(), 1e-9);
    EXPECT_GT(BoxOf(line).sizes().x(), BoxOf(line).sizes().y());
  }
}

TEST(TestPlans, ARollRisesByItsAngle) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const double rise = rng.Uniform(-80, 80);
    const int num_loops = 1 + static_cast<int>(rng.Below(3));
    const Polyline line = AimedPoints(PlanTestRoll(num_loops, rise, rng));
    const Vector2d ends = line.back() - line.front();
    EXPECT_NEAR(std::atan2(-ends.y(), ends.x()), rise * std::numbers::pi / 180, 1e-9);
    EXPECT_GT(ends.norm(), 0.25 * BoxOf(line).diagonal().norm());
    EXPECT_GE(line.size(), static_cast<size_t>(3 * num_loops + 2));
  }
  Rng rng(1);
  testing::ExpectError([&] { PlanTestRoll(0, 45, rng); }, "a roll has 0 loops");
}

}  // namespace
}  // namespace daumier::datasets
