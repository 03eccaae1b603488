#include "models/coefficient_map.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::models {
namespace {

const auto kUnit = faces::ExpressionWeights::kUnit;

torch::Tensor UsualPose(torch::ScalarType type = torch::kFloat64) {
  return torch::tensor({0.1, 0., 0., 0., -1., -40.}, torch::kFloat64).to(type);
}

TEST(CoefficientMap, OfZerosIsTheMeanFaceInItsUsualPose) {
  for (const auto weights : {kUnit, faces::ExpressionWeights::kStandardNormal}) {
    const torch::Tensor x = CoefficientsOf(torch::zeros({1, 239}, torch::kFloat64), weights, UsualPose());
    EXPECT_TRUE(Slot(x, faces::kPoseSlot)[0].equal(UsualPose()));
    EXPECT_EQ(x.slice(1, 0, 233).abs().max().item<double>(), 0);
  }
}

TEST(CoefficientMap, ExpressionWeightsRiseFromAboutZeroToOne) {
  torch::Tensor y = torch::zeros({201, 239}, torch::kFloat64);
  y.select(1, 80).copy_(torch::linspace(-4, 4, 201, torch::kFloat64));
  const torch::Tensor x = CoefficientsOf(y, kUnit, UsualPose()), weights = x.select(1, 80);
  EXPECT_GT((weights.slice(0, 1) - weights.slice(0, 0, 200)).min().item<double>(), 0);
  EXPECT_GT(weights[0].item<double>(), -0.0184);
  EXPECT_LE(weights[200].item<double>(), 1);
  EXPECT_NEAR(weights[125].item<double>(), 0.4908, 1e-3);  // At 1.
  const torch::Tensor clamped = ClampedExpressions(x, kUnit);
  EXPECT_EQ(clamped.select(1, 80).min().item<double>(), 0);
  EXPECT_EQ(clamped.size(1), 239);
}

TEST(CoefficientMap, OtherNumbersAreScaled) {
  const torch::Tensor x = CoefficientsOf(torch::ones({1, 239}), kUnit, UsualPose(torch::kFloat32))[0];
  EXPECT_FLOAT_EQ(x[0].item<float>(), 1);
  EXPECT_FLOAT_EQ(x[150].item<float>(), 1);
  EXPECT_FLOAT_EQ(x[224].item<float>(), 0.3F);
  EXPECT_FLOAT_EQ(x[233].item<float>(), 0.4F);
  EXPECT_FLOAT_EQ(x[236].item<float>(), 2);
  EXPECT_FLOAT_EQ(x[238].item<float>(), -30);
}

TEST(CoefficientMap, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto weights = torch::randn({1, 239}, torch::kFloat64);
  EXPECT_LT(
      testing::MaxGradientError([&](const auto& y) { return (CoefficientsOf(y, kUnit, UsualPose()) * weights).sum(); },
                                torch::randn({1, 239}, torch::kFloat64)),
      1e-7);
}

TEST(CoefficientMap, RefusesAnotherNumber) {
  testing::ExpectError([] { CoefficientsOf(torch::zeros({1, 228}), kUnit, UsualPose()); }, "outputs has shape");
  testing::ExpectError(
      [] {
        CoefficientsOf(torch::zeros({1, 239}), kUnit, UsualPose().slice(0, 1));
      },
      "usual_pose has shape");
}

}  // namespace
}  // namespace daumier::models
