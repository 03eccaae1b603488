#pragma once
#include "core/random.h"
#include "faces/bilinear_model.h"
#include "tests/support/synthetic_face.h"

namespace daumier::testing {

/// A bilinear model of faces that look like the synthetic one: core row (0, 0) is the neutral face, the others move it
/// smoothly by some millimetres. u is about (1, 0, ...), as is v; others deviate by about 0.4.
inline faces::BilinearModel SyntheticBilinear(const faces::FaceTemplate& face_template, int num_identity,
                                              int num_expression, uint64_t seed) {
  Rng rng(seed);
  faces::BilinearModel model;
  model.num_identity = num_identity;
  model.num_expression = num_expression;
  model.core.resize(num_identity * num_expression, 3 * face_template.num_vertices());
  const geometry::Points& neutral = face_template.neutral;
  for (Eigen::Index row = 0; row < model.core.rows(); ++row) {
    geometry::Points shape = neutral;
    if (row > 0) {
      const Eigen::Matrix3d frequency = Eigen::Matrix3d::NullaryExpr([&] { return 0.2 * rng.Normal(); });
      const Eigen::RowVector3d phase = Eigen::RowVector3d::NullaryExpr([&] { return 3 * rng.Normal(); });
      shape = ((neutral * frequency).rowwise() + phase).array().sin();
    }
    for (Eigen::Index v = 0; v < shape.rows(); ++v) model.core.row(row).segment<3>(3 * v) = shape.row(v).cast<float>();
  }
  const auto draw = [&] { return static_cast<float>(0.4 * rng.Normal()); };
  model.identity_factors = Eigen::MatrixXf::NullaryExpr(20, num_identity, draw);
  model.expression_factors = Eigen::MatrixXf::NullaryExpr(9, num_expression, draw);
  model.identity_factors.col(0) = Eigen::VectorXf::NullaryExpr(20, [&] { return 1 + 0.1f * draw(); });
  model.expression_factors.col(0) = Eigen::VectorXf::NullaryExpr(9, [&] { return 1 + 0.1f * draw(); });
  return model;
}

}  // namespace daumier::testing
