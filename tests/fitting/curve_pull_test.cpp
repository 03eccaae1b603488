#include "fitting/curve_pull.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

/// Three points of one curve along x, at y = 100.
const Eigen::VectorXf kCurve = (Eigen::VectorXf(6) << 90, 100, 100, 100, 110, 100).finished();
const CurveOffsets kOffsets = {0, 3};

CurvePull Pull(const render::Stroke& stroke, float reach) {
  return PullOf(SegmentGrid(SegmentsOf({stroke}), reach), kOffsets, kCurve, reach, 0.9f);
}

TEST(PullOf, DrawsToTheNearestPointByTukeysBiweight) {
  const CurvePull pull = Pull({0, {{0, 104}, {250, 104}}}, 8);
  EXPECT_EQ(pull.points, (std::vector<float>{90, 104, 100, 104, 110, 104}));
  // (1 - (4 / 8)^2)^2
  for (const float weight : pull.weights) EXPECT_FLOAT_EQ(weight, 0.5625f);
  EXPECT_TRUE(pull.any());
}

TEST(PullOf, LeavesPointsWhereNoStrokeIsWithinReach) {
  const CurvePull pull = Pull({0, {{0, 109}, {250, 109}}}, 8);
  EXPECT_EQ(pull.points, std::vector<float>(kCurve.begin(), kCurve.end()));
  EXPECT_EQ(pull.weights, std::vector<float>(3, 0.0f));
  EXPECT_FALSE(pull.any());
}

TEST(PullOf, PassesByStrokesThatRunAcross) {
  EXPECT_FALSE(Pull({0, {{100, 0}, {100, 250}}}, 8).any());
}

TEST(PullOf, EndsWhereAStrokeEnds) {
  // Only the last point has the stroke next to it; the middle one reaches its end, 5 pixels along and 3 up.
  const CurvePull pull = Pull({0, {{105, 103}, {250, 103}}}, 8);
  EXPECT_EQ(pull.points, (std::vector<float>{90, 100, 105, 103, 110, 103}));
  EXPECT_FLOAT_EQ(pull.weights[1], (1 - 34.0f / 64) * (1 - 34.0f / 64));
}

}  // namespace
}  // namespace daumier::fitting
