#include "losses/label_loss.h"

#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::losses {
namespace {

TEST(LabelLoss, OfTwoPixelsWorkedOutByHand) {
  // Classes of probability 3/4 and 1/2; weights 2 and 1; a third pixel does not count.
  const torch::Tensor scores = torch::tensor({{{{0., 0., 9.}}, {{std::log(3.), 0., 1.}}}}, torch::kFloat64);
  const torch::Tensor labels = torch::tensor({{{int64_t{1}, int64_t{0}, kNoLabel}}}),
                      weights = torch::tensor({1., 2.}, torch::kFloat64);
  EXPECT_NEAR(LabelLoss(scores, labels, weights).item<double>(), (2 * std::log(4. / 3) + std::log(2.)) / 3, 1e-12);
  EXPECT_EQ(LabelLoss(scores, torch::full({1, 1, 3}, kNoLabel, torch::kInt64), weights).item<double>(), 0);
}

TEST(LabelLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(2);
  const torch::Tensor labels = torch::randint(0, 3, {2, 4, 5}, torch::kInt64),
                      weights = torch::rand({3}, torch::kFloat64);
  labels[0][0][0] = kNoLabel;
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return LabelLoss(x, labels, weights); },
                                      torch::randn({2, 3, 4, 5}, torch::kFloat64)),
            1e-8);
}

}  // namespace
}  // namespace daumier::losses
