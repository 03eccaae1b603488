#include "systems/deform/linear_code_model.h"

#include "faces/controls/face_controls.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

deform::LinearFaces SomeLinearFaces() {
  deform::LinearFaces linear{SyntheticFace(), {}, {}, 3};
  linear.mean = linear.face_template.neutral;
  linear.rows.setZero(2, 3 * linear.face_template.num_vertices());
  linear.rows.row(0).setConstant(0.5f);
  linear.rows(1, 3 * 7 + 1) = 2;
  return linear;
}

TEST(LinearCodeModel, IsTheMeanAndItsRows) {
  const deform::LinearCodeModel model(SomeLinearFaces());
  const Eigen::Vector2d code(2, -1);
  const geometry::Points vertices = model.Vertices(code);
  EXPECT_NEAR(vertices(0, 0), model.face_template().neutral(0, 0) + 1, 1e-6);
  EXPECT_NEAR(vertices(7, 1), model.face_template().neutral(7, 1) + 1 - 2, 1e-6);
  const std::vector<int> some = {7, 0};
  const Eigen::VectorXd positions = model.Positions(code, some);
  EXPECT_NEAR((positions.head<3>() - vertices.row(7).transpose()).norm(), 0, 1e-5);
  EXPECT_NEAR((positions.tail<3>() - vertices.row(0).transpose()).norm(), 0, 1e-5);
  const Eigen::MatrixXd derivative = model.Derivative(code, some);
  EXPECT_EQ(derivative(1, 1), 2);
  EXPECT_EQ(derivative(3, 0), 0.5);
  EXPECT_EQ(model.Latent(code), code);
  ExpectError([&] { (void)model.Vertices(Eigen::Vector3d::Zero()); }, "a code of 3 numbers, expected 2");
}

TEST(LinearCaricatures, HaveIdentitiesExpressionsControlsAndWarps) {
  const faces::FaceModel source = SyntheticModel();
  const deform::LinearCodeModel model(deform::LinearCaricatures(source));
  EXPECT_GT(model.num_numbers(), source.identity_shapes.cols() + source.expression_shapes.cols() + 57);
  Eigen::VectorXd code = Eigen::VectorXd::Zero(model.num_numbers());
  EXPECT_LT((model.Vertices(code) - source.face_template.neutral).norm(), 1e-4);
  code[0] = 1;
  const Eigen::VectorXd moves = source.identity_shapes.col(0).cast<double>();
  EXPECT_LT((model.Vertices(code) - source.face_template.neutral -
             Eigen::Map<const geometry::Points>(moves.data(), moves.size() / 3, 3))
                .cwiseAbs()
                .maxCoeff(),
            1e-4);
  EXPECT_GT(model.usual_radius(), std::sqrt(model.num_numbers()));
}

TEST(LinearCodeModel, RefusesOtherShapes) {
  deform::LinearFaces linear = SomeLinearFaces();
  linear.rows.conservativeResize(2, 12);
  ExpectError([&] { deform::LinearCodeModel model(linear); }, "a linear model of");
}

}  // namespace
}  // namespace daumier::testing
