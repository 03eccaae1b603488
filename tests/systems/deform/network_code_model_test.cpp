#include "systems/deform/network_code_model.h"

#include "core/parallel.h"
#include "systems/deform/linear_code_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_deform_weights.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

/// The comparison with LibTorch's network is in train/run_test.cpp.
namespace daumier::testing {
namespace {

TEST(NetworkCodeModel, IsTheHypernetworksSiren) {
  const TempDir folder;
  const faces::FaceTemplate face = SyntheticFace();
  const Arrays arrays = WriteSmallWeights(folder / "model.safetensors", kSmallHypernetwork, face);
  const deform::NetworkCodeModel model(face, kSmallHypernetwork, folder / "model.safetensors");
  ASSERT_EQ(model.num_numbers(), kLatent);
  const Eigen::Vector4d code(0.5, -1, 0.3, 0.8);
  const geometry::Points vertices = model.Vertices(code);
  const std::vector<int> some = {3, 200, 777};
  const Eigen::VectorXd positions = model.Positions(code, some);
  for (size_t i = 0; i < some.size(); ++i) {
    const Eigen::Vector3d plain = PlainPosition(arrays, model.Latent(code), some[i]);
    EXPECT_LT((vertices.row(some[i]).transpose() - plain).norm(), 1e-3);
    EXPECT_LT((positions.segment<3>(3 * Eigen::Index(i)) - plain).norm(), 1e-3);
  }
}

TEST(NetworkCodeModel, ThreadsGetTheirOwnCodes) {
  const TempDir folder;
  const faces::FaceTemplate face = SyntheticFace();
  WriteSmallWeights(folder / "model.safetensors", kSmallHypernetwork, face);
  const deform::NetworkCodeModel model(face, kSmallHypernetwork, folder / "model.safetensors");
  const std::vector<int> some = FirstVertices(3);
  const auto positions = [&](int i) { return model.Positions(Eigen::Vector4d::Constant(0.1 * i), some); };
  std::vector<Eigen::VectorXd> alone;
  for (int i = 0; i < 20; ++i) alone.push_back(positions(i));
  int next = 0;
  ForEachInOrder(
      400, [&](int i) { return positions(i % 20); },
      [&](const Eigen::VectorXd& found) { EXPECT_EQ(found, alone[size_t(next++ % 20)]); });
}

TEST(NetworkCodeModel, LinearRunsHaveStandardisedRows) {
  const TempDir folder;
  const faces::FaceTemplate face = SyntheticFace();
  const deform::DeformOptions options{.kind = "linear", .latent = kLatent};
  Arrays arrays = WriteSmallWeights(folder / "model.safetensors", options, face);
  const deform::LinearCodeModel model(deform::LinearFacesOfRun(face, options, folder / "model.safetensors"));
  // The code 0 is the face of the mean of the training codes.
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (size_t i = 0; i < arrays["codes"].size(); ++i) mean[Eigen::Index(i % kLatent)] += arrays["codes"][i] / 40.0;
  for (const int vertex : {0, 500}) {
    Eigen::Vector3d plain;
    for (int k = 0; k < 3; ++k) {
      const size_t column = 3 * size_t(vertex) + size_t(k);
      double x = arrays["network.mean"][column];
      for (size_t n = 0; n < kLatent; ++n)
        x += mean[Eigen::Index(n)] * arrays["network.rows"][n * 3 * size_t(face.num_vertices()) + column];
      plain[k] = 10 * x;
    }
    EXPECT_LT((model.Vertices(Eigen::Vector4d::Zero()).row(vertex).transpose() - plain).norm(), 1e-3);
  }
}

TEST(NetworkCodeModel, RefusesOtherWeights) {
  const TempDir folder;
  const faces::FaceTemplate face = SyntheticFace();
  WriteSmallWeights(folder / "model.safetensors", kSmallHypernetwork, face);
  deform::DeformOptions other = kSmallHypernetwork;
  other.hidden_layers = 2;
  ExpectError([&] { deform::NetworkCodeModel(face, other, folder / "model.safetensors"); }, "model.safetensors");
  other = kSmallHypernetwork;
  other.kind = "positions";
  ExpectError([&] { deform::NetworkCodeModel(face, other, folder / "model.safetensors"); }, "cannot be edited");
}

}  // namespace
}  // namespace daumier::testing
