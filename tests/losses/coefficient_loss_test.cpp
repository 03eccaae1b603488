#include "losses/coefficient_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

const auto kDouble = torch::kFloat64;

TEST(CoefficientLoss, IsTheMeanOverKnownPicturesOfWeightedSquares) {
  const auto x = torch::tensor({{1., 2.}, {5., 5.}, {3., 0.}}, kDouble), y = torch::zeros({3, 2}, kDouble);
  const auto weights = torch::tensor({1., 10.}, kDouble), known = torch::tensor({1., 0., 1.}, kDouble);
  EXPECT_DOUBLE_EQ(CoefficientLoss(x, y, weights, known).item<double>(), (41 + 9) / 2.0);
  EXPECT_EQ(CoefficientLoss(x, y, weights, 0 * known).item<double>(), 0);
}

TEST(CoefficientLoss, OfVerticesIsInSquareCentimetres) {
  auto x = torch::zeros({2, 2, 3}, kDouble);
  x[0][1][2] = 2;
  x[1].fill_(9);  // Not known.
  const auto weights = torch::tensor({1., 3.}, kDouble), known = torch::tensor({1., 0.}, kDouble);
  EXPECT_DOUBLE_EQ(KnownVertexLoss(x, torch::zeros_like(x), weights, known).item<double>(), 4 * 3 / 4.0);
}

TEST(CoefficientLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(1);
  const auto known = torch::tensor({1., 0., 1.}, kDouble), y = torch::randn({3, 4}, kDouble),
             weights = torch::rand({4}, kDouble), points = torch::randn({3, 4, 3}, kDouble);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return CoefficientLoss(x, y, weights, known); },
                                      torch::randn({3, 4}, kDouble)),
            1e-8);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return KnownVertexLoss(x, points, weights, known); },
                                      torch::randn({3, 4, 3}, kDouble)),
            1e-8);
}

TEST(CoefficientLoss, RefusesShapesThatDisagree) {
  const auto x = torch::ones({2, 4}), known = torch::ones({2});
  testing::ExpectError([&] { CoefficientLoss(x, torch::ones({2, 3}), torch::ones({4}), known); }, "target has shape");
  testing::ExpectError([&] { CoefficientLoss(x, x, torch::ones({3}), known); }, "weights has shape");
  testing::ExpectError([&] { CoefficientLoss(x, x, torch::ones({4}), torch::ones({3})); }, "known has shape");
  testing::ExpectError([&] { KnownVertexLoss(x, x, torch::ones({4}), known); }, "predicted has shape");
}

}  // namespace
}  // namespace daumier::losses
