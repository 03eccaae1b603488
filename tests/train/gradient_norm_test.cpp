#include "train/gradient_norm.h"

#include "tests/support/expect_error.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include <cmath>
#include <limits>

namespace daumier::train {
namespace {

TEST(GradientNorm, IsTheLengthOfAllTensorsWorkedOutByHand) {
  EXPECT_EQ(GradientNorm({torch::full({2, 2}, 2.0f), torch::full({1}, 3.0f)}).item<double>(), 5);
  EXPECT_EQ(GradientNorm({torch::zeros({3})}).item<double>(), 0);
}

TEST(GradientNorm, AgreesWithLibTorchInEveryLayoutAndType) {
  torch::manual_seed(6);
  for (const int64_t count : {1, 7, 15, 16, 33, 16384, 16390, 50001}) {
    const torch::Tensor one = torch::randn({count}), two = torch::randn({5, 3, 4, 2});
    const double expected = torch::cat({one, two.flatten()}).to(torch::kFloat64).norm().item<double>();
    EXPECT_NEAR(GradientNorm({one, two}).item<double>(), expected, 1e-12 * expected);
    EXPECT_NEAR(GradientNorm({one, two.contiguous(torch::MemoryFormat::ChannelsLast)}).item<double>(), expected,
                1e-12 * expected);
    EXPECT_NEAR(
        GradientNorm({one.to(torch::kFloat64), torch::stack({two, two}).select(0, 1).transpose(0, 1)}).item<double>(),
        expected, 1e-6 * expected);
  }
}

TEST(GradientNorm, DoesNotDependOnTheNumberOfThreads) {
  torch::manual_seed(6);
  const std::vector<torch::Tensor> gradients = {torch::randn({300001}), torch::randn({100})};
  const int threads = at::get_num_threads();
  const double norm = GradientNorm(gradients).item<double>();
  at::set_num_threads(1);
  EXPECT_EQ(GradientNorm(gradients).item<double>(), norm);
  at::set_num_threads(threads);
}

TEST(GradientNorm, IsNotFiniteIfANumberIsNot) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    torch::Tensor gradient = torch::ones({40});
    gradient[21] = bad;
    EXPECT_FALSE(std::isfinite(GradientNorm({torch::ones({3}), gradient}).item<double>()));
  }
  testing::ExpectError([] { GradientNorm({}); }, "no gradient");
}

TEST(GradientNorm, OfLargeNumbersDoesNotOverflow) {
  EXPECT_NEAR(GradientNorm({torch::full({4}, 1e30f)}).item<double>(), 2e30, 1e24);
}

}  // namespace
}  // namespace daumier::train
