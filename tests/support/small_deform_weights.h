#pragma once
#include "core/random.h"
#include "core/safetensors.h"
#include "faces/face_model.h"
#include "systems/deform/network_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <vector>

/// A small deformable network with random weights, and its equations by plain loops.
namespace daumier::testing {

inline constexpr int kLatent = 4, kHyper = 16, kWidth = 16;
inline const deform::DeformOptions kSmallHypernetwork{
    .kind = "hypernetwork", .latent = kLatent, .width = kWidth, .hidden_layers = 1, .omega = 3, .hyper_width = kHyper};

using Arrays = std::map<std::string, std::vector<float>>;

/// Writes random weights of a small model of a kind.
inline Arrays WriteSmallWeights(const std::filesystem::path& file, const deform::DeformOptions& options,
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
  } else if (options.kind == "conditioning") {
    add("network.shared", {options.siren().num_parameters()}, 0.2);
    for (const char* name : {"network.first_code", "network.mid_code"}) add(name, {kWidth, options.latent}, 0.2);
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

inline std::vector<int> FirstVertices(int count) {
  std::vector<int> vertices(static_cast<size_t>(count));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

/// W x + b by plain loops.
inline std::vector<double> Dense(const Arrays& arrays, const std::string& name, const std::vector<double>& x,
                                 bool rectified) {
  const std::vector<float>&w = arrays.at(name + ".weight"), &b = arrays.at(name + ".bias");
  std::vector<double> y(b.begin(), b.end());
  for (size_t o = 0; o < y.size(); ++o) {
    for (size_t i = 0; i < x.size(); ++i) y[o] += double(w[o * x.size() + i]) * x[i];
    if (rectified) y[o] = std::max(y[o], 0.0);
  }
  return y;
}

/// One point by the equations of the paper, cm.
inline Eigen::Vector3d PlainPosition(const Arrays& arrays, const Eigen::VectorXd& latent, int vertex) {
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

}  // namespace daumier::testing
