#include "losses/reflectance_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

TEST(ReflectanceLoss, IsTheVarianceOfTheSkinAlone) {
  // Skin of red 0 and 1: a variance of 1/4. The third vertex is no skin.
  const auto albedo = torch::tensor({0., 0., 0., 1., 0., 0., 9., 9., 9.}, torch::kFloat64).view({1, 3, 3});
  EXPECT_NEAR(ReflectanceLoss(albedo, torch::tensor({1., 1., 0.}, torch::kFloat64)).item<double>(), 0.25, 1e-12);
  EXPECT_NEAR(ReflectanceLoss(albedo, torch::tensor({0., 1., 0.}, torch::kFloat64)).item<double>(), 0, 1e-12);
}

TEST(ReflectanceLoss, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto weights = torch::rand({4}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError([&](const auto& at) { return ReflectanceLoss(at, weights); },
                                      torch::rand({2, 4, 3}, torch::kFloat64)),
            1e-8);
}

TEST(ReflectanceLoss, RefusesShapesThatDisagree) {
  testing::ExpectError([] { ReflectanceLoss(torch::ones({1, 4, 3}), torch::ones({3})); }, "weights has shape");
}

}  // namespace
}  // namespace daumier::losses
