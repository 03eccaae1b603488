#include "systems/deform/train/baselines.h"

#include "tensor/eigen.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/linalg.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

/// Faces of 20 vertices in a space of three directions and, with noise, a little outside it.
torch::Tensor Faces(int64_t count, uint64_t seed, double noise = 0) {
  torch::manual_seed(9);
  const torch::Tensor axes = torch::randn({3, 60}), mean = torch::randn({60});
  torch::manual_seed(seed);
  return (mean + torch::matmul(torch::randn({count, 3}), axes) + noise * torch::randn({count, 60}))
      .reshape({count, 20, 3});
}

double Error(const torch::Tensor& predicted, const torch::Tensor& truth) {
  return (predicted - truth).norm(2, {2}).mean().item<double>();
}

TEST(DeformBaselines, MeanIsThatOfTheTrainingFaces) {
  const torch::Tensor training = Faces(30, 1);
  EXPECT_TRUE(torch::allclose(DeformBaselines(training.clone(), Faces(4, 2), 3).Mean(), training.mean(0), 1e-4, 1e-5));
}

TEST(DeformBaselines, NearestIsThatOfASearchFaceByFace) {
  const torch::Tensor training = Faces(30, 1), faces = Faces(5, 3);
  const torch::Tensor nearest = DeformBaselines(training.clone(), Faces(4, 2), 3).Nearest(faces);
  for (int64_t i = 0; i < 5; ++i) {
    const int64_t best = (training - faces[i]).square().sum({1, 2}).argmin().item<int64_t>();
    EXPECT_TRUE(torch::allclose(nearest[i], training[best], 1e-4, 1e-4));
  }
}

TEST(DeformBaselines, LinearModelGivesFacesOfItsSpaceBack) {
  const DeformBaselines baselines(Faces(30, 1), Faces(4, 2), 3);
  const torch::Tensor faces = Faces(5, 3);
  EXPECT_EQ(baselines.ridge(), 0) << "without noise nothing is gained by a prior";
  EXPECT_LT(Error(baselines.Linear(faces), faces), 1e-4);
  EXPECT_GT(Error(DeformBaselines(Faces(30, 1), Faces(4, 2), 2).Linear(faces), faces), 0.05);
}

TEST(DeformBaselines, LinearModelIsTheLeastSquaresOneThatIsDrawnToTheMean) {
  const DeformBaselines baselines(Faces(12, 1, 0.3), Faces(20, 2, 0.3), 11);
  const torch::Tensor faces = Faces(3, 3, 0.3), flat = (faces - baselines.Mean()).reshape({3, 60});
  const auto& components = baselines.linear_model().components;
  const torch::Tensor rows = tensor::CopyToTensor(components.rows);
  const torch::Tensor variances = tensor::CopyToTensor(components.deviations).square();
  // By the normal equations of |x - c D|^2 + ridge mean(v) sum c_k^2 / v_k.
  const torch::Tensor matrix =
      torch::matmul(rows, rows.t()) + torch::diag(baselines.ridge() * variances.mean() / variances);
  const torch::Tensor scores = torch::matmul(torch::matmul(flat, rows.t()), matrix.inverse());
  const torch::Tensor expected = torch::matmul(scores, rows).reshape({3, 20, 3}) + baselines.Mean();
  EXPECT_LT(Error(baselines.Linear(faces), expected), 1e-4);
}

TEST(DeformBaselines, HasAtMostOneComponentLessThanTrainingFaces) {
  EXPECT_EQ(DeformBaselines(Faces(6, 1, 0.3), Faces(4, 2), 128).linear_model().components.rows.rows(), 5);
}

TEST(DeformBaselines, CountsTheComponentsThatExplainAShare) {
  const torch::Tensor training = Faces(30, 1);
  const torch::Tensor flat = (training - training.mean(0)).reshape({30, 60}).to(torch::kFloat64);
  const torch::Tensor variances = std::get<1>(torch::linalg_svd(flat)).square();
  const double first = (variances[0] / variances.sum()).item<double>();
  const DeformBaselines baselines(training.clone(), Faces(4, 2), 2);
  EXPECT_EQ(baselines.ComponentsFor(first - 0.01), 1);
  EXPECT_EQ(baselines.ComponentsFor(first + 0.01), 2);
  EXPECT_EQ(baselines.ComponentsFor(0.9999), std::nullopt) << "there are three directions";
}

TEST(DeformBaselines, RefusesTooFewFaces) {
  testing::ExpectError([] { DeformBaselines(Faces(1, 1), Faces(4, 2), 3); }, "not 1");
  testing::ExpectError([] { DeformBaselines(Faces(9, 1), Faces(0, 2), 3); }, "none");
  const DeformBaselines baselines(Faces(9, 1), Faces(4, 2), 3);
  testing::ExpectError([&] { baselines.Nearest(torch::zeros({1, 19, 3})); }, "57 coordinates, expected 60");
}

}  // namespace
}  // namespace daumier::deform
