#include "losses/state_loss.h"

#include "losses/label_loss.h"
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::losses {
namespace {

TEST(StateLoss, IsTheMeanOfTheKnownStates) {
  const torch::Tensor scores = torch::tensor({{0., std::log(3.), 1., 1., 1.}, {5., 5., 0., 0., 0.}}, torch::kFloat64);
  const torch::Tensor classes = torch::tensor({{int64_t{1}, int64_t{2}}, {int64_t{0}, kNoLabel}});
  const torch::Tensor weights = torch::ones({2}, torch::kFloat64);
  EXPECT_NEAR(StateLoss(scores, {2, 3}, classes, weights).item<double>(),
              (std::log(4. / 3) + std::log(3.) + std::log(2.)) / 3, 1e-12);
  EXPECT_EQ(StateLoss(scores, {2, 3}, torch::full({2, 2}, kNoLabel, torch::kInt64), weights).item<double>(), 0);
}

TEST(StateLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(3);
  const torch::Tensor classes = torch::tensor({{int64_t{1}, int64_t{2}}, {kNoLabel, int64_t{0}}}),
                      weights = torch::tensor({0.5, 2.}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError(
                [&](const auto& x) {
                  return StateLoss(x, {2, 3}, classes, weights);
                },
                torch::randn({2, 5}, torch::kFloat64)),
            1e-8);
  testing::ExpectError([&] { StateLoss(torch::zeros({2, 4}), {2, 3}, classes, weights); }, "scores has shape (2, 4)");
}

}  // namespace
}  // namespace daumier::losses
