#pragma once
#include "core/random.h"
#include "faces/bilinear_model.h"

namespace daumier::testing {

/// A bilinear model of random numbers: core and factors standard normal; 20 fitted identities, 7 fitted expressions.
inline faces::BilinearModel RandomBilinear(int num_vertices, int num_identity, int num_expression, uint64_t seed) {
  Rng rng(seed);
  const auto draw = [&] { return static_cast<float>(rng.Normal()); };
  faces::BilinearModel model;
  model.num_identity = num_identity;
  model.num_expression = num_expression;
  model.core = faces::BilinearModel::Core::NullaryExpr(num_identity * num_expression, 3 * num_vertices, draw);
  model.identity_factors = Eigen::MatrixXf::NullaryExpr(20, num_identity, draw);
  model.expression_factors = Eigen::MatrixXf::NullaryExpr(7, num_expression, draw);
  return model;
}

}  // namespace daumier::testing
