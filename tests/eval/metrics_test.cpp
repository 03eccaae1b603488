#include "eval/metrics.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::eval {
namespace {

// Vertex 0 is off by (3, 4, 0) cm, vertex 1 is exact, vertex 2 by (0, 0, 1) cm.
const std::vector<float> kTruth = {0, 0, 0, 1, 1, 1, 2, 2, 2};
const std::vector<float> kPredicted = {3, 4, 0, 1, 1, 1, 2, 2, 3};

TEST(VertexErrors, AreLengthsInMillimetres) {
  EXPECT_EQ(VertexErrors(kPredicted, kTruth, 10.0), (std::vector<double>{50, 0, 10}));
  EXPECT_EQ(VertexErrors(kTruth, kTruth, 10.0), (std::vector<double>{0, 0, 0}));
}

TEST(VertexErrors, RefuseFacesOfAnotherLength) {
  EXPECT_THROW(VertexErrors(std::vector<float>(6), kTruth, 10.0), Error);
  EXPECT_THROW(VertexErrors(std::vector<float>(7), std::vector<float>(7), 10.0), Error);
}

TEST(MeanVertexError, IsTheMeanOverTheRegionAlone) {
  EXPECT_DOUBLE_EQ(MeanVertexError(kPredicted, kTruth, std::vector<int>{0, 1, 2}, 10.0), 20.0);
  EXPECT_DOUBLE_EQ(MeanVertexError(kPredicted, kTruth, std::vector<int>{1, 2}, 12.0), 6.0);
}

TEST(MeanVertexError, RefusesARegionThatIsEmptyOrNotOfTheFace) {
  EXPECT_THROW(MeanVertexError(kPredicted, kTruth, std::vector<int>{}, 10.0), Error);
  EXPECT_THROW(MeanVertexError(kPredicted, kTruth, std::vector<int>{3}, 10.0), Error);
  EXPECT_THROW(MeanVertexError(kPredicted, kTruth, std::vector<int>{-1}, 10.0), Error);
}

TEST(MeanVertexError, IsTheSameAfterMovingBothFacesButNotAfterMovingOne) {
  std::vector<float> moved_truth = kTruth, moved_prediction = kPredicted;
  for (float& coordinate : moved_truth) coordinate += 5;
  for (float& coordinate : moved_prediction) coordinate += 5;
  const std::vector<int> region = {0, 1, 2};
  EXPECT_DOUBLE_EQ(MeanVertexError(moved_prediction, moved_truth, region, 10.0), 20.0);
  EXPECT_GT(MeanVertexError(moved_prediction, kTruth, region, 10.0), 20.0);
}

TEST(MeanVertexDistance, IsTheMeanOverAllVerticesOfAllFaces) {
  FaceRows truth = FaceRows::Zero(2, 6), predicted = truth;
  predicted.row(0) << 3, 4, 0, 0, 0, 0;
  predicted.row(1) << 0, 0, 1, 0, 0, 2;
  EXPECT_DOUBLE_EQ(MeanVertexDistance(predicted, truth), 2);
  EXPECT_EQ(MeanVertexDistance(truth, truth), 0);
  EXPECT_THROW(MeanVertexDistance(predicted.topRows(1), truth), Error);
  EXPECT_THROW(MeanVertexDistance(FaceRows(0, 6), FaceRows(0, 6)), Error);
  predicted(1, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(MeanVertexDistance(predicted, truth), Error);
}

TEST(VertexDistance, IsEuclidean) {
  const std::vector<float> face = {1, 2, 3, 0, 0, 0, 4, 6, 3};
  EXPECT_DOUBLE_EQ(VertexDistance(face, 0, 2), 5.0);
  EXPECT_DOUBLE_EQ(VertexDistance(face, 2, 0), 5.0);
}

}  // namespace
}  // namespace daumier::eval
