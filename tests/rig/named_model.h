#pragma once
#include "tests/support/synthetic_model.h"

namespace daumier::testing {

/// SyntheticModel() whose seven expression shapes have names of ARKit and ICT: jawOpen, mouthSmile_L, mouthSmile_R,
/// eyeBlink_L, eyeBlink_R, and browInnerUp in two halves of one shape.
inline faces::FaceModel NamedModel() {
  faces::FaceModel model = SyntheticModel();
  Eigen::MatrixXf& shapes = model.expression_shapes;
  model.expression_shape_names = {"jawOpen",    "mouthSmile_L",  "mouthSmile_R", "eyeBlink_L",
                                  "eyeBlink_R", "browInnerUp_L", "browInnerUp_R"};
  shapes.col(6) = 0.5f * shapes.col(5);
  shapes.col(5) = shapes.col(6);
  return model;
}

}  // namespace daumier::testing
