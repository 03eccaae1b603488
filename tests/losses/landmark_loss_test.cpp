#include "losses/landmark_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

TEST(LandmarkLoss, OfTwoLandmarksWorkedOutByHand) {
  // Distances^2 of 25 and 4 with weights 2 and 10, over 2 landmarks and 1 picture.
  const auto p = torch::tensor({{{3., 4.}, {0., 2.}}}, torch::kFloat64), q = torch::zeros({1, 2, 2}, torch::kFloat64);
  EXPECT_DOUBLE_EQ(LandmarkLoss(p, q, torch::tensor({2., 10.}, torch::kFloat64)).item<double>(), 45);
  EXPECT_DOUBLE_EQ(LandmarkLoss(p, q, torch::tensor({{2., 10.}}, torch::kFloat64)).item<double>(), 45);
}

TEST(LandmarkLoss, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto p = torch::randn({3, 5, 2}, torch::kFloat64), q = torch::randn({3, 5, 2}, torch::kFloat64),
             weights = torch::rand({3, 5}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return LandmarkLoss(x, q, weights); }, p), 1e-8);
}

TEST(LandmarkLoss, WeighsBridgeOfTheNoseAndInnerLips) {
  const torch::Tensor weights = PortraitLandmarkWeights();
  for (int n = 0; n < 68; ++n) EXPECT_EQ(weights[n].item<float>(), (n >= 28 && n <= 30) || n >= 60 ? 20 : 1) << n;
}

TEST(LandmarkLoss, RefusesShapesThatDisagree) {
  const auto p = torch::zeros({2, 5, 2}), weights = torch::ones({5});
  testing::ExpectError([&] { LandmarkLoss(p, torch::zeros({2, 4, 2}), weights); }, "target has shape");
  testing::ExpectError([&] { LandmarkLoss(p, p, torch::ones({4})); }, "weights has shape");
  testing::ExpectError([&] { LandmarkLoss(p, p, torch::ones({3, 5})); }, "weights has shape");
}

}  // namespace
}  // namespace daumier::losses
