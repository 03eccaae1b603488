#include "eval/metrics.h"

#include "core/error.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <numeric>

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

TEST(VertexDistance, IsEuclidean) {
  const std::vector<float> face = {1, 2, 3, 0, 0, 0, 4, 6, 3};
  EXPECT_DOUBLE_EQ(VertexDistance(face, 0, 2), 5.0);
  EXPECT_DOUBLE_EQ(VertexDistance(face, 2, 0), 5.0);
}

TEST(Percentile, IsLinearBetweenNeighboursInOrder) {
  const std::vector<double> values = {4, 1, 2};
  EXPECT_DOUBLE_EQ(Percentile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Percentile(values, 50), 2);
  EXPECT_DOUBLE_EQ(Percentile(values, 75), 3);
  EXPECT_DOUBLE_EQ(Percentile(values, 100), 4);
  EXPECT_THROW(Percentile({}, 50), Error);
}

TEST(PersonBootstrap, OfOnePersonIsTheMean) {
  const Interval interval = PersonBootstrap(std::vector<double>{1, 2, 6}, std::vector<int>{7, 7, 7}, 1);
  EXPECT_DOUBLE_EQ(interval.low, 3);
  EXPECT_DOUBLE_EQ(interval.high, 3);
}

TEST(PersonBootstrap, IsWiderThanOverFacesWhereFacesOfAPersonAgree) {
  Rng rng(5);
  std::vector<double> errors;
  std::vector<int> persons;
  for (int person = 0; person < 12; ++person) {
    const double level = rng.Uniform(1, 3);
    for (int face = 0; face < 25; ++face) {
      errors.push_back(level + 0.05 * rng.Normal());
      persons.push_back(person);
    }
  }
  std::vector<int> each_its_own(errors.size());
  std::iota(each_its_own.begin(), each_its_own.end(), 0);
  const Interval by_person = PersonBootstrap(errors, persons, 3);
  const Interval by_face = PersonBootstrap(errors, each_its_own, 3);
  EXPECT_GT(by_person.high - by_person.low, 3 * (by_face.high - by_face.low));
  EXPECT_LT(by_person.low, Mean(errors));
  EXPECT_GT(by_person.high, Mean(errors));
}

TEST(PersonBootstrap, IsDeterministicInItsSeed) {
  const std::vector<double> errors = {1, 2, 3, 4};
  const std::vector<int> persons = {0, 1, 2, 3};
  const Interval first = PersonBootstrap(errors, persons, 11), second = PersonBootstrap(errors, persons, 11);
  EXPECT_EQ(first.low, second.low);
  EXPECT_EQ(first.high, second.high);
}

TEST(PersonBootstrap, CoversTheNormalIntervalOfAMean) {
  // The mean of 400 persons with unit deviation has a standard error of 1/20, so the interval is about +-0.098 wide.
  Rng rng(9);
  std::vector<double> errors(400);
  std::vector<int> persons(400);
  std::iota(persons.begin(), persons.end(), 0);
  for (double& error : errors) error = rng.Normal();
  const Interval interval = PersonBootstrap(errors, persons, 4);
  EXPECT_NEAR(interval.high - interval.low, 2 * 1.96 / 20, 0.03);
}

}  // namespace
}  // namespace daumier::eval
