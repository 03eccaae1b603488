#include "systems/deform/network_code_model.h"

#include "core/random.h"
#include "core/safetensors.h"
#include "systems/deform/linear_code_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

/// The comparison with LibTorch's network is in train/run_test.cpp.
namespace daumier::testing {
namespace {

constexpr int kLatent = 4, kHyper = 16, kWidth = 16;
const deform::DeformOptions kSmallHypernetwork{
    .kind = "hypernetwork", .latent = kLatent, .width = kWidth, .hidden_layers = 1, .omega = 3, .hyper_width = kHyper};

using Arrays = std::map<std::string, std::vector<float>>;

/// Writes random weights of a small model of a kind.
Arrays WriteSmallWeights(const std::filesystem::path& file, const deform::DeformOptions& options,
                         const faces::FaceTemplate& face) {
  Rng rng(3);
  Arrays arrays;
  SafetensorsWriter writer;
  const auto add = [&](const std::string& name, const std::vector<int64_t>& shape, double deviation) {
    int64_t count = 1;
    for (const int64_t size : shape) count *= size;
    std::vector<float>& numbers = arrays[name];
    for (int64_t i = 0; i < count; ++i) numbers.push_back(float(deviation * rng.Normal()));
    writer.Add<float>(name, shape, numbers);
  };
  const int64_t num_vertices = face.num_vertices();
  std::vector<float>& vertices = arrays["network.template_vertices"];
  for (const double x : face.neutral.reshaped<Eigen::RowMajor>()) vertices.push_back(float(0.1 * x));
  writer.Add<float>("network.template_vertices", {num_vertices, 3}, vertices);
  const std::vector<double> frame = {0.1, 0, 0, 0};
  writer.Add<double>("network.model_from_cm", {4}, frame);
  add("codes", {40, options.latent}, 0.5);
  if (options.kind == "linear") {
    add("network.mean", {3 * num_vertices}, 1);
    add("network.rows", {options.latent, 3 * num_vertices}, 0.1);
  } else {
    const runtime::SirenLayout siren = options.siren();
    for (int layer = 0; layer < siren.num_layers(); ++layer) {
      for (const std::string part : {"weights_", "biases_"}) {
        const std::string name = "network." + part + std::to_string(layer);
        const int64_t outputs = siren.outputs(layer) * (part == "weights_" ? siren.inputs(layer) : 1);
        add(name + ".first.weight", {kHyper, options.latent}, 0.5);
        add(name + ".first.bias", {kHyper}, 0.1);
        add(name + ".second.weight", {kHyper, kHyper}, 0.3);
        add(name + ".second.bias", {kHyper}, 0.1);
        add(name + ".last.weight", {outputs, kHyper}, 0.1);
        add(name + ".last.bias", {outputs}, 0.05);
      }
    }
  }
  writer.Write(file);
  return arrays;
}

/// W x + b by plain loops.
std::vector<double> Dense(const Arrays& arrays, const std::string& name, const std::vector<double>& x, bool rectified) {
  const std::vector<float>&w = arrays.at(name + ".weight"), &b = arrays.at(name + ".bias");
  std::vector<double> y(b.begin(), b.end());
  for (size_t o = 0; o < y.size(); ++o) {
    for (size_t i = 0; i < x.size(); ++i) y[o] += double(w[o * x.size() + i]) * x[i];
    if (rectified) y[o] = std::max(y[o], 0.0);
  }
  return y;
}

/// One point by the equations of the paper, cm.
Eigen::Vector3d PlainPosition(const Arrays& arrays, const Eigen::VectorXd& latent, int vertex) {
  const std::vector<double> z(latent.begin(), latent.end());
  const std::vector<float>& t = arrays.at("network.template_vertices");
  const std::vector<double> point = {t[3 * size_t(vertex)], t[3 * size_t(vertex) + 1], t[3 * size_t(vertex) + 2]};
  std::vector<double> x = point;
  const int num_layers = kSmallHypernetwork.siren().num_layers();
  for (int layer = 0; layer < num_layers; ++layer) {
    const auto made = [&](const std::string& part) {
      const std::string name = "network." + part + std::to_string(layer);
      return Dense(arrays, name + ".last",
                   Dense(arrays, name + ".second", Dense(arrays, name + ".first", z, true), true), false);
    };
    const std::vector<double> w = made("weights_"), b = made("biases_");
    std::vector<double> y = b;
    for (size_t o = 0; o < y.size(); ++o) {
      for (size_t i = 0; i < x.size(); ++i) y[o] += w[o * x.size() + i] * x[i];
      if (layer + 1 < num_layers) y[o] = std::sin(kSmallHypernetwork.omega * y[o]);
    }
    x = y;
  }
  return 10 * (Eigen::Vector3d(x[0], x[1], x[2]) + Eigen::Vector3d(point[0], point[1], point[2]));
}

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

TEST(NetworkCodeModel, DerivativeIsThatOfPositions) {
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
      EXPECT_LT((derivative.block<3, 1>(3 * Eigen::Index(i), n) - plain).norm(), 0.02 * (1 + plain.norm()));
    }
  }
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
