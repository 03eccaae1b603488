#include "losses/heat_map_loss.h"

#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::losses {
namespace {

TEST(HeatMapLoss, IsZeroIffTheSoftmaxIsThePointsDistribution) {
  const torch::Tensor points = torch::tensor({{{2.3, 4.1}, {5.5, 0.7}}}, torch::kFloat64),
                      weights = torch::ones({1, 2}, torch::kFloat64);
  const torch::Tensor ideal = PointDistributions(points, 6, 8, 1.1).log() + 3;  // Any constant.
  EXPECT_NEAR(HeatMapLoss(ideal, points, weights, 1.1).item<double>(), 0, 1e-12);
  torch::Tensor other = ideal.clone();
  other[0][1][0][0] += 5;
  EXPECT_GT(HeatMapLoss(other, points, weights, 1.1).item<double>(), 1e-4);
  EXPECT_NEAR(HeatMapLoss(other, points, torch::tensor({{1., 0.}}, torch::kFloat64), 1.1).item<double>(), 0, 1e-12);
}

TEST(HeatMapLoss, OfAFlatMapIsTheLogarithmOfItsCellsLessTheEntropy) {
  const torch::Tensor points = torch::tensor({{{8.0, 8.0}}}, torch::kFloat64);
  const double loss =
      HeatMapLoss(torch::zeros({1, 1, 16, 16}, torch::kFloat64), points, torch::ones({1, 1}, torch::kFloat64), 1.5)
          .item<double>();
  EXPECT_NEAR(loss, std::log(256.0) - std::log(2 * M_PI * std::exp(1.0) * 2.25), 1e-3);
}

TEST(HeatMapLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(2);
  const torch::Tensor points = 5 * torch::rand({2, 3, 2}, torch::kFloat64),
                      weights = torch::rand({2, 3}, torch::kFloat64),
                      maps = torch::randn({2, 3, 5, 4}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return HeatMapLoss(x, points, weights, 0.9); }, maps), 1e-8);
}

TEST(HeatMapLoss, PointsOfAnyValueAreFinite) {
  const torch::Tensor points = torch::tensor({{{-1e4, 3.0}}}, torch::kFloat64);
  EXPECT_TRUE(PointDistributions(points, 4, 4, 1).isfinite().all().item<bool>());
}

TEST(HeatMapLoss, RefusesShapesThatDisagree) {
  const torch::Tensor maps = torch::zeros({2, 3, 4, 4}), points = torch::zeros({2, 3, 2}),
                      weights = torch::zeros({2, 3});
  testing::ExpectError([&] { HeatMapLoss(maps, points.slice(1, 1), weights, 1); }, "points has shape");
  testing::ExpectError([&] { HeatMapLoss(maps, points, weights.slice(0, 1), 1); }, "weights has shape");
  testing::ExpectError([&] { HeatMapLoss(maps, points, weights, 0); }, "expected a positive number");
}

}  // namespace
}  // namespace daumier::losses
