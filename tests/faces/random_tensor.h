#pragma once
#include "core/random.h"
#include "faces/bilinear_model.h"

#include <set>
#include <span>
#include <utility>

namespace daumier::faces {

/// A tensor of faces in memory, some of them held out.
struct Tensor {
  int num_identities, num_expressions, num_coordinates;
  Eigen::MatrixXf faces;  ///< 3V x (I * E), column i * E + e
  std::set<std::pair<int, int>> held_out = {};

  auto face(int i, int e) const { return faces.col(i * num_expressions + e); }
  std::span<const float> Read(int i, int e) const {
    if (held_out.count({i, e}) > 0) return {};
    return {face(i, e).data(), static_cast<size_t>(num_coordinates)};
  }
  BilinearModel Fit(int num_identity, int num_expression) const {
    return FitBilinear(num_identities, num_expressions, num_coordinates, [this](int i, int e) { return Read(i, e); },
                       {.num_identity = num_identity, .num_expression = num_expression});
  }
};

inline Eigen::MatrixXf RandomMatrix(int rows, int columns, Rng& rng) {
  return Eigen::MatrixXf::NullaryExpr(rows, columns, [&rng] { return static_cast<float>(rng.Normal()); });
}

/// A mean face of some 10 cm, and of each further bilinear component a tenth of the one before.
inline Tensor RandomTensor(int num_identities, int num_expressions, int num_coordinates, uint64_t seed) {
  Rng rng(seed);
  Tensor tensor{num_identities, num_expressions, num_coordinates,
                RandomMatrix(num_coordinates, num_identities * num_expressions, rng)};
  tensor.faces.colwise() += Eigen::VectorXf(RandomMatrix(num_coordinates, 1, rng) * 10.0f);
  return tensor;
}

inline Eigen::VectorXf FittedFace(const BilinearModel& model, int i, int e) {
  return Reconstruct(model, model.identity_factors.row(i), model.expression_factors.row(e));
}

}  // namespace daumier::faces
