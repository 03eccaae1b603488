#include "datasets/gestures/pen_motion.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

WriterHand SteadyHand(HandModel model) {
  WriterHand hand;
  hand.model = model;
  return hand;
}

constexpr HandModel kHandModels[] = {HandModel::kLognormal, HandModel::kMinimumJerk, HandModel::kSpring};

TEST(MovePen, ASteadyHandReachesTheEndsOfThePlan) {
  const PenPlan plan = {{{10, 20}}, {{90, 40}}, {{60, 120}, true}, {{200, 150}}};
  for (const HandModel model : kHandModels) {
    Rng rng(1);
    const Polyline path = MovePen(plan, SteadyHand(model), rng);
    const double most = model == HandModel::kSpring ? 5 : 1e-6;
    EXPECT_LT((path.front() - plan.front().at).norm(), most);
    EXPECT_LT((path.back() - plan.back().at).norm(), most);
  }
}

TEST(MovePen, AStraightPlanStaysStraight) {
  for (const HandModel model : kHandModels) {
    Rng rng(2);
    for (const Vector2d& point : MovePen({{{0, 0}}, {{30, 15}}, {{100, 50}}}, SteadyHand(model), rng)) {
      EXPECT_NEAR(point.x() - 2 * point.y(), 0, 1e-9);
    }
  }
}

TEST(MovePen, OneMovementHasOnePeakOfSpeed) {
  for (const HandModel model : {HandModel::kLognormal, HandModel::kMinimumJerk}) {
    Rng rng(3);
    const Polyline path = MovePen({{{0, 0}}, {{100, 0}}}, SteadyHand(model), rng);
    std::vector<double> speeds;
    for (size_t i = 1; i < path.size(); ++i) speeds.push_back((path[i] - path[i - 1]).norm());
    const auto peak = std::max_element(speeds.begin(), speeds.end());
    EXPECT_TRUE(std::is_sorted(speeds.begin(), peak));
    EXPECT_TRUE(std::is_sorted(peak, speeds.end(), std::greater<>()));
    // The lognormal speed rises faster than it falls.
    const auto rise = static_cast<double>(peak - speeds.begin()) / static_cast<double>(speeds.size());
    EXPECT_NEAR(rise, model == HandModel::kLognormal ? 0.3 : 0.5, 0.08);
  }
}

TEST(MovePen, FourPointsOfACircleMakeACircle) {
  PenPlan plan;
  for (int i = 0; i <= 4; ++i) {
    const double angle = std::numbers::pi / 2 * i;
    plan.push_back({{100 * std::cos(angle), 100 * std::sin(angle)}});
  }
  WriterHand hand;
  hand.overlap = 0;
  Rng rng(4);
  // The inner arcs are exact; those of the free ends bend once and a half as much as their one tangent demands.
  const Polyline path = MovePen(plan, hand, rng);
  for (const Vector2d& point : Part(path, 0.3, 0.7, 50)) EXPECT_NEAR(point.norm(), 100, 0.5);
  hand.overlap = 0.4;  // Overlap cuts off what lies between.
  for (const Vector2d& point : Part(MovePen(plan, hand, rng), 0.3, 0.7, 50)) EXPECT_LT(point.norm(), 101);
}

TEST(MovePen, IsAFunctionOfItsSeed) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Rng a(seed), b(seed);
    const PenPlan plan = {{{0, 0}}, {{50, 80}}, {{120, 10}, true}, {{160, 90}}};
    const WriterHand hand = DrawWriterHand(a), other = DrawWriterHand(b);
    EXPECT_EQ(MovePen(plan, hand, a), MovePen(plan, other, b));
  }
}

TEST(MovePen, AHurriedHandStaysNearThePlan) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng(seed);
    const Polyline path = MovePen({{{0, 0}}, {{200, 0}, true}, {{200, 200}}}, DrawWriterHand(rng), rng);
    for (const Vector2d& point : path) EXPECT_LT(DistanceTo({{0, 0}, {200, 0}, {200, 200}}, point), 60);
    EXPECT_GT(LengthOf(path), 250);
  }
}

TEST(MovePen, AStrokeNeedsTwoPoints) {
  Rng rng(5);
  testing::ExpectError([&] { MovePen({{{0, 0}}}, {}, rng); }, "has 1 points, expected at least 2");
}

}  // namespace
}  // namespace daumier::datasets
