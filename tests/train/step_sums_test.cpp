#include "train/step_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::train {
namespace {

torch::Tensor Scalar(double value) {
  return torch::full({}, value, torch::kFloat32);
}

TEST(StepSums, AddsTheNumbersOfStepsInDoublePrecision) {
  StepSums sums;
  for (int step = 0; step < 3; ++step) sums.Add(step, {{"loss", Scalar(0.5)}, {"part", Scalar(step)}});
  EXPECT_EQ(sums.num_steps(), 3);
  EXPECT_EQ(sums.Totals(), (std::map<std::string, double>{{"loss", 1.5}, {"part", 3}}));
  sums.Clear();
  EXPECT_EQ(sums.num_steps(), 0);
  sums.Add(3, {{"loss", Scalar(2)}, {"part", Scalar(1)}});
  EXPECT_EQ(sums.Totals(), (std::map<std::string, double>{{"loss", 2}, {"part", 1}}));
}

TEST(StepSums, KeepsTotalsWhereStepsHaveOtherNames) {
  StepSums sums;
  sums.Add(0, {{"loss", Scalar(1)}, {"entropy", Scalar(4)}});
  sums.Add(1, {{"loss", Scalar(2)}, {"distance", Scalar(8)}});
  sums.Add(2, {{"loss", Scalar(3)}, {"entropy", Scalar(1)}});
  EXPECT_EQ(sums.Totals(), (std::map<std::string, double>{{"distance", 8}, {"entropy", 5}, {"loss", 6}}));
}

TEST(StepSums, LoadedTotalsContinueToTheSameBytes) {
  StepSums whole, begun, resumed;
  const auto step = [](int i) { return std::map<std::string, torch::Tensor>{{"loss", Scalar(1.0 / (3 + i))}}; };
  for (int i = 0; i < 9; ++i) whole.Add(i, step(i));
  for (int i = 0; i < 4; ++i) begun.Add(i, step(i));
  resumed.Load(begun.Totals(), begun.num_steps());
  for (int i = 4; i < 9; ++i) resumed.Add(i, step(i));
  EXPECT_EQ(resumed.Totals(), whole.Totals());
  EXPECT_EQ(resumed.num_steps(), 9);
}

TEST(StepSums, RemembersTheFirstStepThatIsNotFiniteWithItsLossFirst) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  StepSums sums;
  EXPECT_FALSE(sums.FirstNotFinite());
  sums.Add(7, {{"angle", Scalar(1)}, {"gradient_norm", Scalar(1)}, {"loss", Scalar(1)}});
  EXPECT_FALSE(sums.FirstNotFinite());
  sums.Add(8, {{"angle", Scalar(1)}, {"gradient_norm", Scalar(infinite)}, {"loss", Scalar(1)}});
  sums.Add(9, {{"angle", Scalar(nan)}, {"gradient_norm", Scalar(nan)}, {"loss", Scalar(nan)}});
  EXPECT_EQ(sums.FirstNotFinite()->step, 8);
  EXPECT_EQ(sums.FirstNotFinite()->name, "gradient_norm");
  EXPECT_EQ(sums.FirstNotFinite()->value, infinite);

  StepSums others;
  others.Add(3, {{"angle", Scalar(nan)}, {"gradient_norm", Scalar(nan)}, {"loss", Scalar(nan)}});
  EXPECT_EQ(others.FirstNotFinite()->name, "loss");
  EXPECT_TRUE(std::isnan(others.FirstNotFinite()->value));
}

}  // namespace
}  // namespace daumier::train
