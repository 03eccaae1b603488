#include "losses/opening_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

TEST(OpeningLoss, OfOneLidWorkedOutByHand) {
  // The opening is 3 px higher and 4 px wider than the true one.
  auto p = torch::zeros({1, 68, 2}, torch::kFloat64), q = p.clone();
  p[0][37][0] = 4;
  p[0][37][1] = 3;
  EXPECT_NEAR(OpeningLoss(p, q, {{37, 41}}).item<double>(), 5 - 0.01, 1e-4);
  EXPECT_NEAR(OpeningLoss(p, q, EyelidPairs()).item<double>(), (5 - 0.01) / 4, 1e-4);
  EXPECT_EQ(OpeningLoss(q, q, LipPairs()).item<double>(), 0);
}

TEST(OpeningLoss, DoesNotChangeWhenAllLandmarksMove) {
  torch::manual_seed(1);
  const auto p = torch::randn({2, 68, 2}, torch::kFloat64), q = torch::randn({2, 68, 2}, torch::kFloat64);
  EXPECT_NEAR(OpeningLoss(p + 7, q, EyelidPairs()).item<double>(), OpeningLoss(p, q, EyelidPairs()).item<double>(),
              1e-12);
}

TEST(OpeningLoss, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto p = torch::randn({2, 68, 2}, torch::kFloat64), q = torch::randn({2, 68, 2}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError([&](const auto& at) { return OpeningLoss(at, q, LipPairs()); }, p), 1e-7);
}

TEST(OpeningLoss, RefusesLandmarksThatAreNotThere) {
  const auto p = torch::zeros({1, 60, 2});
  testing::ExpectError([&] { OpeningLoss(p, p, LipPairs()); }, "the pair of landmarks 61 and 67 is not among 60");
  testing::ExpectError([&] { OpeningLoss(p, p, {}); }, "needs a pair");
}

}  // namespace
}  // namespace daumier::losses
