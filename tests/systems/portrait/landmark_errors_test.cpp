#include "systems/portrait/landmark_errors.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

TEST(NormalisedError, IsThatOfTheLandmarksThatAreKnown) {
  std::vector<float> truth(136, std::numeric_limits<float>::quiet_NaN()), points(136, 7);
  truth[72] = points[72] = 10;
  truth[73] = truth[91] = points[91] = 7;
  truth[90] = 60;
  points[90] = 65;
  EXPECT_NEAR(NormalisedError(points, truth), 5.0 / 50 / 2, 1e-9);
  EXPECT_NEAR(NormalisedError(points, truth, 36, 48), 5.0 / 50 / 2, 1e-9);
  EXPECT_TRUE(std::isnan(NormalisedError(points, truth, 0, 17)));
  EXPECT_NEAR(ErrorsOfLandmarks(points, truth)[45], 0.1, 1e-9);
  truth[90] = std::numeric_limits<float>::quiet_NaN();
  testing::ExpectError([&] { NormalisedError(points, truth); }, "are not known");
}

TEST(LabelCounts, AreIntersectionAndUnionOfKnownPixels) {
  LabelCounts counts;
  counts.Add(std::vector<int64_t>{1, 1, 0, 3}, std::vector<int64_t>{1, 0, 0, -100});
  EXPECT_DOUBLE_EQ(counts.iou(PictureClass::kSkin), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(PictureClass::kBackground), 0.5);
  EXPECT_DOUBLE_EQ(counts.iou(PictureClass::kEyes), 1);
}

}  // namespace
}  // namespace daumier::portrait
