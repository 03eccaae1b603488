#include "render/ticks.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::render {
namespace {

using Strings = std::vector<std::string>;

Strings Labels(const std::vector<Tick>& ticks) {
  Strings labels;
  for (const Tick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

TEST(NiceStep, TakesOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(NiceStep(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(NiceStep(10.0, 9), 2.0);
  EXPECT_DOUBLE_EQ(NiceStep(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(NiceStep(10.0, 4), 5.0);
  EXPECT_DOUBLE_EQ(NiceStep(11.0, 1), 20.0);
  EXPECT_DOUBLE_EQ(NiceStep(0.3, 3), 0.1);
  EXPECT_DOUBLE_EQ(NiceStep(0.07, 3), 0.05);
  EXPECT_DOUBLE_EQ(NiceStep(4.6e6, 5), 1e6);
}

TEST(NiceStep, IsTheSmallestThatHasNotTooManySteps) {
  for (double range = 1e-4; range < 1e5; range *= 1.37) {
    for (const int max_steps : {1, 2, 3, 7, 24}) {
      const double step = NiceStep(range, max_steps);
      EXPECT_LE(range / step, max_steps * (1.0 + 1e-9)) << range << " " << max_steps;
      // The next smaller step is at least 2 / 5 as large.
      EXPECT_GT(range / (step / 2.5), max_steps * (1.0 - 1e-9)) << range << " " << max_steps;
    }
  }
}

TEST(NiceStep, RefusesRangesThatAreNone) {
  EXPECT_THROW(NiceStep(0.0, 5), Error);
  EXPECT_THROW(NiceStep(-1.0, 5), Error);
  EXPECT_THROW(NiceStep(std::numeric_limits<double>::infinity(), 5), Error);
  EXPECT_THROW(NiceStep(std::numeric_limits<double>::quiet_NaN(), 5), Error);
  EXPECT_THROW(NiceStep(1.0, 0), Error);
}

TEST(NiceCeiling, IsTheFirstMultipleOfANiceStepFromTheValueOn) {
  EXPECT_DOUBLE_EQ(NiceCeiling(4.6, 5), 5.0);
  EXPECT_DOUBLE_EQ(NiceCeiling(5.0, 5), 5.0);
  EXPECT_DOUBLE_EQ(NiceCeiling(5.2, 5), 6.0);
  EXPECT_DOUBLE_EQ(NiceCeiling(0.3, 3), 0.3);
  EXPECT_THROW(NiceCeiling(0.0, 5), Error);
}

TEST(NiceTicks, LabelsHaveTheDecimalsOfTheStep) {
  EXPECT_EQ(Labels(NiceTicks(0.0, 1.0, 5)), (Strings{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(Labels(NiceTicks(0.0, 0.1, 2)), (Strings{"0.00", "0.05", "0.10"}));
  EXPECT_EQ(Labels(NiceTicks(0.0, 400.0, 4)), (Strings{"0", "100", "200", "300", "400"}));
}

TEST(NiceTicks, AreTheMultiplesWithinTheRange) {
  const auto ticks = NiceTicks(3.2, 9.7, 4);
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_EQ(ticks[0].value, 4.0);
  EXPECT_EQ(ticks[1].value, 6.0);
  EXPECT_EQ(ticks[2].value, 8.0);
  EXPECT_EQ(Labels(ticks), (Strings{"4", "6", "8"}));
}

TEST(NiceTicks, KeepEndsThatRoundingMovedAndCallZeroZero) {
  EXPECT_EQ(Labels(NiceTicks(0.1 + 0.2, 0.9, 6)), (Strings{"0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"}));
  EXPECT_EQ(Labels(NiceTicks(-1.0, 1.0, 4)), (Strings{"-1.0", "-0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(Labels(NiceTicks(-0.3, 1.2, 2)), (Strings{"0", "1"}));
}

TEST(NiceTicks, RefuseRangesThatAreNone) {
  EXPECT_THROW(NiceTicks(1.0, 1.0, 4), Error);
  EXPECT_THROW(NiceTicks(2.0, 1.0, 4), Error);
  EXPECT_THROW(NiceTicks(0.0, 1.0, 0), Error);
}

}  // namespace
}  // namespace daumier::render
