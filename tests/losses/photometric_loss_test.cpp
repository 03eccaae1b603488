#include "losses/photometric_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

TEST(PhotometricLoss, OfTwoPixelsWorkedOutByHand) {
  // Differences (0.3, 0.4, 0) and (0, 0, 1); the masked mean of lengths 0.5 and 1 with weights 1 and 0.5.
  const auto type = torch::kFloat64;
  const auto rendered = torch::tensor({0.3, 0., 0.4, 0., 0., 1.}, type).view({1, 3, 1, 2});
  const auto picture = torch::zeros({1, 3, 1, 2}, type), mask = torch::tensor({1., 0.5}, type).view({1, 1, 1, 2});
  EXPECT_NEAR(PhotometricLoss(rendered, picture, mask).item<double>(), (0.5 + 0.5) / 1.5, 1e-5);
  EXPECT_NEAR(PhotometricLoss(rendered, picture, mask, ColourDistance::kSquared).item<double>(), (0.25 + 0.5) / 1.5,
              1e-12);
}

TEST(PhotometricLoss, OfAnEmptyMaskIsZero) {
  const auto picture = torch::rand({1, 3, 2, 2});
  EXPECT_EQ(PhotometricLoss(picture, 1 - picture, torch::zeros({1, 1, 2, 2})).item<float>(), 0);
}

TEST(PhotometricLoss, GradientEqualsCentralDifferencesAndDoesNotReachTheMask) {
  torch::manual_seed(2);
  const auto x = torch::rand({2, 3, 3, 4}, torch::kFloat64), y = torch::rand({2, 3, 3, 4}, torch::kFloat64);
  auto mask = torch::rand({2, 1, 3, 4}, torch::kFloat64);
  for (const ColourDistance distance : {ColourDistance::kLength, ColourDistance::kSquared})
    EXPECT_LT(testing::MaxGradientError([&](const auto& at) { return PhotometricLoss(at, y, mask, distance); }, x),
              1e-7);
  mask.set_requires_grad(true);
  EXPECT_FALSE(PhotometricLoss(x, y, mask).requires_grad());
}

TEST(PhotometricLoss, RefusesShapesThatDisagree) {
  const auto x = torch::zeros({2, 3, 4, 5});
  testing::ExpectError(
      [&] {
        PhotometricLoss(x, torch::zeros({2, 3, 4, 4}), torch::ones({2, 1, 4, 5}));
      },
      "picture has shape");
  testing::ExpectError([&] { PhotometricLoss(x, x, torch::ones({2, 4, 5})); }, "mask has shape");
}

}  // namespace
}  // namespace daumier::losses
