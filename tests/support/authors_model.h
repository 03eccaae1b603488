#pragma once
#include "core/json.h"
#include "core/random.h"
#include "faces/model_frame.h"
#include "geometry/obj.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/torch_checkpoint.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

/// A small deformable model with random weights as the program of [Jung et al. 2022] stores it, and its equations by
/// plain loops over these names.
namespace daumier::testing {

struct AuthorsSizes {
  int64_t faces = 40, latent = 8, width = 16, hyper_width = 32, layers = 5;
};
inline constexpr AuthorsSizes kPaperSizes{1268, 128, 128, 256, 5};

/// Calls `add(name, shape, deviation)` for each tensor in the order of the authors' state.
template <class Add>
void ForEachAuthorsTensor(const AuthorsSizes& sizes, Add add) {
  add("latent_codes.weight", {sizes.faces, sizes.latent}, 1e-3);
  const auto outputs = [&](int64_t layer) { return layer + 1 == sizes.layers ? 3 : sizes.width; };
  const auto inputs = [&](int64_t layer) { return layer == 0 ? 3 : sizes.width; };
  for (int64_t layer = 0; layer < sizes.layers; ++layer) {
    const std::string name = fmt::format("deform_net.net.net.{}.0.", layer);
    add(name + "weight", {outputs(layer), inputs(layer)}, 1);  // Never used.
    add(name + "bias", {outputs(layer)}, 1);
  }
  for (int64_t branch = 0; branch < 2 * sizes.layers; ++branch) {
    const int64_t layer = branch / 2, made = outputs(layer) * (branch % 2 == 0 ? inputs(layer) : 1);
    const std::string name = fmt::format("hyper_net.nets.{}.net.", branch);
    add(name + "0.0.weight", {sizes.hyper_width, sizes.latent}, 300 / std::sqrt(double(sizes.latent)));
    add(name + "0.0.bias", {sizes.hyper_width}, 0.3);
    add(name + "1.0.weight", {sizes.hyper_width, sizes.hyper_width}, std::sqrt(2.0 / double(sizes.hyper_width)));
    add(name + "1.0.bias", {sizes.hyper_width}, 0.1);
    const double share = layer + 1 == sizes.layers ? 1 : 0.2;  // Of layers before sines, which are to stay smooth.
    add(name + "2.0.weight", {made, sizes.hyper_width}, 0.01 * share);
    add(name + "2.0.bias", {made}, 0.05 * share);
  }
}

inline NamedArrays AuthorsState(const AuthorsSizes& sizes = {}) {
  Rng rng(5);
  NamedArrays state;
  ForEachAuthorsTensor(sizes, [&](const std::string& name, const std::vector<int64_t>& shape, double deviation) {
    FloatArray& array = state[name] = FloatArray(shape);
    for (float& number : array.values) number = float(deviation * rng.Normal());
  });
  return state;
}

/// W x + b of a layer of a network of the state.
inline std::vector<double> AuthorsDense(const NamedArrays& state, const std::string& name,
                                        const std::vector<double>& x) {
  const std::vector<float>&w = state.at(name + ".weight").values, &b = state.at(name + ".bias").values;
  std::vector<double> y(b.begin(), b.end());
  for (size_t o = 0; o < y.size(); ++o)
    for (size_t i = 0; i < x.size(); ++i) y[o] += double(w[o * x.size() + i]) * x[i];
  return y;
}

/// Where a point of the template goes, by the equations of the paper.
inline Eigen::Vector3d AuthorsPosition(const NamedArrays& state, const Eigen::VectorXd& latent,
                                       const Eigen::Vector3d& point, int layers = 5) {
  const auto made = [&](int branch) {
    std::vector<double> x(latent.begin(), latent.end());
    for (int i = 0; i < 3; ++i) {
      x = AuthorsDense(state, fmt::format("hyper_net.nets.{}.net.{}.0", branch, i), x);
      if (i < 2)
        for (double& neuron : x) neuron = std::max(neuron, 0.0);
    }
    return x;
  };
  std::vector<double> x(point.begin(), point.end());
  for (int layer = 0; layer < layers; ++layer) {
    const std::vector<double> weights = made(2 * layer);
    std::vector<double> y = made(2 * layer + 1);
    for (size_t o = 0; o < y.size(); ++o) {
      for (size_t i = 0; i < x.size(); ++i) y[o] += weights[o * x.size() + i] * x[i];
      if (layer + 1 < layers) y[o] = std::sin(30 * y[o]);
    }
    x = y;
  }
  return point + Eigen::Vector3d(x[0], x[1], x[2]);
}

/// The synthetic face where the authors' template lies.
inline geometry::Points AuthorsTemplate() {
  const faces::FaceTemplate face = SyntheticFace();
  return faces::HeadFrame(face, 2.1).FromCm(face.neutral);
}

/// Landmarks and hairline of it, 10 cm a unit.
inline Json AuthorsAnnotation() {
  const faces::FaceTemplate face = SyntheticFace();
  return {{"format", 1},
          {"landmarks", face.annotation.landmarks},
          {"hairline", face.annotation.hairline_vertex},
          {"cm_per_unit", 10}};
}

/// Writes checkpoint.pth, template.obj and template.json, all that `daumier import` reads. Returns the state.
inline NamedArrays WriteAuthorsFiles(const std::filesystem::path& folder) {
  NamedArrays state = AuthorsState();
  WriteTorchState(folder / "checkpoint.pth", state);
  geometry::WriteObj(folder / "template.obj", geometry::TriangleMesh{AuthorsTemplate(), SyntheticFace().triangles});
  WriteQuickly(folder / "template.json", AuthorsAnnotation().dump());
  return state;
}

}  // namespace daumier::testing
