#include "core/statistics.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace daumier {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

TEST(Mean, IsThatOfTheValues) {
  EXPECT_DOUBLE_EQ(Mean(std::vector<double>{4, 1, 2.5}), 2.5);
}

TEST(Median, IsTheMiddleValueOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_DOUBLE_EQ(Median(std::vector<double>{9, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(Median(std::vector<double>{9, 1, 2, 3}), 2.5);
}

TEST(Statistics, RefuseNoValues) {
  testing::ExpectError([] { Mean({}); }, "a mean of no values");
  testing::ExpectError([] { Percentile({}, 50); }, "a percentile of no values");
  testing::ExpectError([] { Median({}); }, "of no values");
  testing::ExpectError([] { PersonBootstrap({}, {}, 1); }, "a bootstrap of no values");
}

TEST(Statistics, RefuseValuesThatAreNotFiniteByTheirIndex) {
  const std::vector<int> persons = {0, 1, 2};
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    const std::vector<double> values = {1, 2, bad};
    testing::ExpectError([&] { Mean(values); }, "number 2 is");
    testing::ExpectError([&] { Percentile(values, 50); }, "number 2 is");
    testing::ExpectError([&] { Median(values); }, "number 2 is");
    testing::ExpectError([&] { PersonBootstrap(values, persons, 1); }, "number 2 is");
  }
}

TEST(Percentile, RefusesAPercentOutOfRange) {
  const std::vector<double> values = {1, 2};
  for (const double percent : {-0.1, 100.1, kNaN})
    testing::ExpectError([&] { Percentile(values, percent); }, "expected 0 to 100");
}

TEST(Percentile, AgreesWithSorting) {
  Rng rng(3);
  std::vector<double> values(101);
  for (double& value : values) value = rng.Normal();
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (int percent = 0; percent <= 100; ++percent) EXPECT_NEAR(Percentile(values, percent), sorted[percent], 1e-12);
}

TEST(PersonBootstrap, RefusesOtherLengthsAndNoDraws) {
  testing::ExpectError(
      [] {
        PersonBootstrap(std::vector<double>{1, 2}, std::vector<int>{0}, 1);
      },
      "2 errors of 1 faces");
  testing::ExpectError([] { PersonBootstrap(std::vector<double>{1}, std::vector<int>{0}, 1, 0); }, "of 0 draws");
}

TEST(Percentile, IsLinearBetweenNeighboursInOrder) {
  const std::vector<double> values = {4, 1, 2};
  EXPECT_DOUBLE_EQ(Percentile(values, 0), 1);
  EXPECT_DOUBLE_EQ(Percentile(values, 50), 2);
  EXPECT_DOUBLE_EQ(Percentile(values, 75), 3);
  EXPECT_DOUBLE_EQ(Percentile(values, 100), 4);
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
}  // namespace daumier
