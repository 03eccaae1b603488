#include "losses/coefficient_prior_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

TEST(CoefficientPriorLoss, IsTheWeightedSumOfSquaresWithThePapersWeights) {
  const auto type = torch::kFloat64;
  const auto identity = torch::tensor({{1., 2.}, {0., 0.}}, type), expression = torch::tensor({{3.}, {0.}}, type),
             albedo = torch::tensor({{10.}, {0.}}, type);
  EXPECT_NEAR(CoefficientPriorLoss(identity, expression, albedo).item<double>(), (1.2 * 5 + 1.0 * 9 + 1.2e-3 * 100) / 2,
              1e-12);
  EXPECT_EQ(CoefficientPriorLoss(0 * identity, 0 * expression, 0 * albedo).item<double>(), 0);
}

TEST(CoefficientPriorLoss, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto x = torch::randn({3, 6}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError(
                [&](const auto& at) {
                  return CoefficientPriorLoss(at.narrow(1, 0, 3), at.narrow(1, 3, 2), at.narrow(1, 5, 1));
                },
                x),
            1e-8);
}

TEST(CoefficientPriorLoss, RefusesBatchesThatDiffer) {
  testing::ExpectError(
      [] {
        CoefficientPriorLoss(torch::ones({2, 3}), torch::ones({1, 3}), torch::ones({2, 3}));
      },
      "expression has shape");
}

}  // namespace
}  // namespace daumier::losses
