#include "tensor/principal_components.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/linalg.h>
#include <torch/utils.h>

namespace daumier::tensor {
namespace {

/// 80 rows of 50 numbers around 3, with deviations that fall by a fifth from each direction to the next.
torch::Tensor Rows() {
  torch::manual_seed(4);
  const torch::Tensor axes = std::get<0>(torch::linalg_qr(torch::randn({50, 50})));
  const torch::Tensor scores = torch::randn({80, 50}) * torch::pow(0.8, torch::arange(50));
  return torch::matmul(scores, axes) + 3;
}

TEST(PrincipalComponents, AreThoseOfTheSingularValueDecomposition) {
  const torch::Tensor rows = Rows();
  torch::Tensor centred = rows.clone();
  const PrincipalComponents components = FitPrincipalComponents(centred, 10);
  EXPECT_TRUE(torch::allclose(components.mean, rows.mean(0)));
  EXPECT_TRUE(torch::allclose(centred, rows - rows.mean(0)));
  const auto [u, s, v] = torch::linalg_svd((rows - rows.mean(0)).to(torch::kFloat64), false);
  const torch::Tensor deviations = s / std::sqrt(80.0);
  EXPECT_TRUE(torch::allclose(components.deviations.to(torch::kFloat64), deviations.slice(0, 0, 10), 1e-4));
  const torch::Tensor same = torch::matmul(components.directions.to(torch::kFloat64), v.slice(0, 0, 10).t());
  EXPECT_LT((same.abs() - torch::eye(10, torch::kFloat64)).abs().max().item<double>(), 1e-3);
  EXPECT_NEAR(components.total_variance, deviations.square().sum().item<double>(), 1e-4);
}

TEST(PrincipalComponents, DirectionsAreOrthonormal) {
  torch::Tensor rows = Rows();
  const torch::Tensor directions = FitPrincipalComponents(rows, 20).directions;
  EXPECT_TRUE(torch::allclose(torch::matmul(directions, directions.t()), torch::eye(20), 0, 1e-4));
}

TEST(PrincipalComponents, CountsThoseThatExplainAShare) {
  PrincipalComponents components;
  components.deviations = torch::tensor({2.0f, 1.0f, 0.5f});
  components.total_variance = 6;
  EXPECT_EQ(components.NumFor(0.5), 1);
  EXPECT_EQ(components.NumFor(0.8), 2);
  EXPECT_EQ(components.NumFor(0.87), 3);
  EXPECT_EQ(components.NumFor(0.99), 4) << "more than there are";
}

TEST(PrincipalComponents, EqualRowsGiveEqualComponents) {
  torch::Tensor a = Rows(), b = Rows();
  EXPECT_TRUE(FitPrincipalComponents(a, 5).directions.equal(FitPrincipalComponents(b, 5).directions));
}

TEST(PrincipalComponents, RefusesMoreThanTheRowsSpan) {
  torch::Tensor rows = Rows();
  testing::ExpectError([&] { FitPrincipalComponents(rows, 51); }, "51 principal components of 80 rows of 50");
  torch::Tensor line = torch::arange(20, torch::kFloat32).unsqueeze(1) * torch::ones({1, 30});
  testing::ExpectError([&] { FitPrincipalComponents(line, 2); }, "span fewer");
}

}  // namespace
}  // namespace daumier::tensor
