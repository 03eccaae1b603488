#include "models/principal_components.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/linalg.h>
#include <torch/utils.h>

namespace daumier::models {
namespace {

/// Vectors whose deviations fall from direction to direction.
torch::Tensor SomeVectors() {
  torch::manual_seed(9);
  return torch::matmul(torch::randn({60, 40}) * torch::pow(0.8, torch::arange(40)), torch::randn({40, 50})) + 3;
}

TEST(PrincipalComponents, AreThoseOfTheSingularValueDecomposition) {
  const torch::Tensor vectors = SomeVectors(), centred = vectors - vectors.mean(0);
  const auto [u, s, vh] = torch::linalg_svd(centred, false);
  const PrincipalComponents components = FitPrincipalComponents(vectors, 5, 1);
  EXPECT_TRUE(torch::allclose(components.mean, vectors.mean(0)));
  EXPECT_TRUE(torch::allclose(components.deviations, s.narrow(0, 0, 5) / std::sqrt(60.0), 1e-4));
  const torch::Tensor cosines = torch::matmul(components.rows, vh.narrow(0, 0, 5).t()).abs();
  EXPECT_TRUE(torch::allclose(cosines, torch::eye(5), 1e-3, 1e-3));
}

TEST(PrincipalComponents, AreOrthonormalAndTheSameForASeed) {
  const PrincipalComponents components = FitPrincipalComponents(SomeVectors(), 7, 4);
  EXPECT_TRUE(torch::allclose(torch::matmul(components.rows, components.rows.t()), torch::eye(7), 1e-4, 1e-5));
  EXPECT_TRUE(torch::equal(components.rows, FitPrincipalComponents(SomeVectors(), 7, 4).rows));
}

TEST(PrincipalComponents, NeedMoreVectorsThanComponents) {
  testing::ExpectError(
      [] {
        FitPrincipalComponents(torch::zeros({5, 9}), 5, 1);
      },
      "5 principal components of 5 vectors");
}

}  // namespace
}  // namespace daumier::models
