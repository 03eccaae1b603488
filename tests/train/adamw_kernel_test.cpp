#include "train/adamw_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::train {
namespace {

constexpr AdamWFactors kFactors{
    .beta1 = 0.9, .beta2 = 0.999, .decay = 0.999, .root_correction = 0.5, .step_size = 0.01};

TEST(AdamWKernel, ChangesItsRangeAlone) {
  if (!HasAdamWKernel()) GTEST_SKIP() << "no processor with FMA";
  const std::vector<float> gradient(40, 2);
  std::vector<float> mean(40, 1), square(40, 4), parameter(40, 3);
  AdamWKernel(kFactors, {gradient.data(), mean.data(), square.data(), parameter.data()}, 3, 36);
  const double v = 0.999 * 4 + 0.001 * 4, m = 0.9 + 0.1 * 2, p = 0.999 * 3 - 0.01 * m / (std::sqrt(v) / 0.5);
  for (size_t i = 0; i < 40; ++i) {
    const bool is_inside = i >= 3 && i < 36;
    EXPECT_NEAR(mean[i], is_inside ? m : 1, 1e-6) << i;
    EXPECT_NEAR(square[i], is_inside ? v : 4, 1e-6) << i;
    EXPECT_NEAR(parameter[i], is_inside ? p : 3, 1e-6) << i;
  }
}

TEST(AdamWKernel, TheNumbersDoNotDependOnHowTheRangeIsCut) {
  if (!HasAdamWKernel()) GTEST_SKIP() << "no processor with FMA";
  std::vector<float> gradient(100);
  for (size_t i = 0; i < 100; ++i) gradient[i] = std::sin(float(i));
  std::vector<float> mean(100, 1), square(100, 4), parameter(100, 3);
  std::vector<float> mean2 = mean, square2 = square, parameter2 = parameter;
  AdamWKernel(kFactors, {gradient.data(), mean.data(), square.data(), parameter.data()}, 0, 100);
  for (const auto& [begin, end] : {std::pair{0, 5}, {5, 22}, {22, 100}})
    AdamWKernel(kFactors, {gradient.data(), mean2.data(), square2.data(), parameter2.data()}, begin, end);
  EXPECT_EQ(parameter, parameter2);
  EXPECT_EQ(mean, mean2);
  EXPECT_EQ(square, square2);
}

}  // namespace
}  // namespace daumier::train
