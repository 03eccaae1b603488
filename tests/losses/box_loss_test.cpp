#include "losses/box_loss.h"

#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::losses {
namespace {

BoxTargets OneBox() {
  BoxTargets targets{torch::zeros({1, 3, 3}, torch::kFloat64), torch::zeros({1, 4, 3, 3}, torch::kFloat64),
                     torch::zeros({1, 3, 3}, torch::kFloat64)};
  targets.score[0][1][1] = 1;
  targets.score[0][1][2] = 0.5;
  targets.weight[0][1][1] = 1;
  targets.box[0][2][1][1] = 0.7;
  return targets;
}

TEST(BoxLoss, WorkedOutByHand) {
  const BoxLossTerms terms = BoxLoss(torch::zeros({1, 5, 3, 3}, torch::kFloat64), OneBox());
  const double entropy = std::log(2.0) / 4;  // Of p = 1/2 in each of the nine cells.
  EXPECT_NEAR(terms.score.item<double>(), entropy * (1 + 7 + 1.0 / 16), 1e-12);
  EXPECT_NEAR(terms.box.item<double>(), 0.7, 1e-12);
}

TEST(BoxLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(4);
  const BoxTargets targets = OneBox();
  EXPECT_LT(testing::MaxGradientError(
                [&](const auto& x) {
                  const BoxLossTerms terms = BoxLoss(x, targets);
                  return terms.score + terms.box;
                },
                torch::randn({1, 5, 3, 3}, torch::kFloat64)),
            1e-8);
}

TEST(BoxLoss, OfAPictureWithoutABoxIsThatOfItsScoresAlone) {
  const BoxTargets none{torch::zeros({1, 2, 2}), torch::zeros({1, 4, 2, 2}), torch::zeros({1, 2, 2})};
  const BoxLossTerms terms = BoxLoss(torch::full({1, 5, 2, 2}, -20.f), none);
  EXPECT_NEAR(terms.score.item<double>(), 0, 1e-6);
  EXPECT_EQ(terms.box.item<double>(), 0);
}

}  // namespace
}  // namespace daumier::losses
