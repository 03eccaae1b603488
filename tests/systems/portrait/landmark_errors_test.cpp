#include "systems/portrait/landmark_errors.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(NormalisedError, IsTheMeanDistanceOverThatOfTheEyeCorners) {
  std::vector<float> truth(136, 0), points = truth;
  truth[72] = points[72] = 10;
  truth[90] = points[90] = 60;
  points[0] = 3;
  points[1] = 4;  // Landmark 0 misses by 5 pixels.
  EXPECT_NEAR(NormalisedError(points, truth), 5.0 / 50 / 68, 1e-9);
  EXPECT_NEAR(NormalisedError(points, truth, 0, 17), 5.0 / 50 / 17, 1e-9);
  EXPECT_EQ(NormalisedError(points, truth, 36, 48), 0);
  testing::ExpectError([&] { NormalisedError(truth, std::vector<float>(136, 0)); }, "are one point");
}

TEST(LabelCounts, AreIntersectionAndUnionOfKnownPixels) {
  LabelCounts counts;
  counts.Add(std::vector<int64_t>{1, 1, 0, 3}, std::vector<int64_t>{1, 0, 0, -100});
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kSkin), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kBackground), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(FaceClass::kEye), 1);
}

}  // namespace
}  // namespace daumier::portrait
