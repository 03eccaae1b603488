#include "systems/deform/deform_weights.h"

#include "systems/deform/network_code_model.h"
#include "tests/support/small_deform_weights.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

TEST(DeformWeights, DerivativeIsThatOfThePlainEquations) {
  const TempDir folder;
  const faces::FaceTemplate face = SyntheticFace();
  const Arrays arrays = WriteSmallWeights(folder / "model.safetensors", kSmallHypernetwork, face);
  const deform::NetworkCodeModel model(face, kSmallHypernetwork, folder / "model.safetensors");
  const Eigen::Vector4d code(0.2, 0.1, -0.4, 0.6);
  const std::vector<int> some = {5, 400};
  const Eigen::MatrixXd derivative = model.Derivative(code, some);
  for (int n = 0; n < kLatent; ++n) {
    constexpr double kStep = 1e-4;
    const Eigen::VectorXd ahead = model.Latent(code + kStep * Eigen::Vector4d::Unit(n)),
                          behind = model.Latent(code - kStep * Eigen::Vector4d::Unit(n));
    for (size_t i = 0; i < some.size(); ++i) {
      const Eigen::Vector3d plain =
          (PlainPosition(arrays, ahead, some[i]) - PlainPosition(arrays, behind, some[i])) / (2 * kStep);
      EXPECT_LT((derivative.block<3, 1>(3 * Eigen::Index(i), n) - plain).norm(), 1e-4 * (1 + plain.norm()));
    }
  }
}

TEST(DeformWeights, DerivativesOfManyPointsAreCentralDifferences) {
  const faces::FaceTemplate face = SyntheticFace();
  const std::vector<int> many = FirstVertices(150);
  for (const char* kind : {"hypernetwork", "conditioning"}) {
    const TempDir folder;
    deform::DeformOptions options = kSmallHypernetwork;
    options.kind = kind;
    WriteSmallWeights(folder / "model.safetensors", options, face);
    const deform::NetworkCodeModel model(face, options, folder / "model.safetensors");
    const Eigen::Vector4d code(0.2, 0.1, -0.4, 0.6);
    const Eigen::MatrixXd derivative = model.Derivative(code, many);
    ASSERT_EQ(derivative.rows(), 450);
    for (int n = 0; n < kLatent; ++n) {
      constexpr double kStep = 2e-3;
      const Eigen::VectorXd plain = (model.Positions(code + kStep * Eigen::Vector4d::Unit(n), many) -
                                     model.Positions(code - kStep * Eigen::Vector4d::Unit(n), many)) /
                                    (2 * kStep);
      EXPECT_LT((derivative.col(n) - plain).cwiseAbs().maxCoeff(), 5e-3 * (1 + plain.cwiseAbs().maxCoeff())) << kind;
    }
  }
}

/// Only the inputs that are not 0 are read.
TEST(DeformWeights, HyperLayerIsWxPlusB) {
  const std::vector<float> weights = {1, 2, 3, 4, 5, 6}, bias = {0.5f, -1};  // 2 outputs, 3 inputs
  const deform::HyperLayer layer(weights, bias, 2, 3);
  const std::vector<int> active = {0, 2};
  const std::vector<float> values = {10, 100};
  float y[2];
  layer.Apply(active, values, 0, 2, y);
  EXPECT_EQ(y[0], 1 * 10 + 3 * 100 + 0.5f);
  EXPECT_EQ(y[1], 4 * 10 + 6 * 100 - 1);
  layer.Apply(active, values, 1, 1, y);
  EXPECT_EQ(y[0], 4 * 10 + 6 * 100 - 1);
}

}  // namespace
}  // namespace daumier::testing
