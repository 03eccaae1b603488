#include "fitting/exaggerated_face.h"

#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <array>

namespace daumier::testing {
namespace {

TEST(ExaggeratedFace, MultipliesTheCodeOfAFaceOfTheModel) {
  const FieldModel model;
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.6, -0.5, 0.3, 1.2, -0.7, 0.4;
  const geometry::Points face = model.Vertices(code);
  const geometry::Points exaggerated = fitting::ExaggeratedFace(model, face, 0.5);
  // The code's ridge makes it shorter by little.
  EXPECT_LT((exaggerated - model.Vertices(1.5 * code)).rowwise().norm().maxCoeff(), 0.05);
  EXPECT_EQ(fitting::ExaggeratedFace(model, face, 0), face);
}

TEST(ExaggeratedFace, KeepsWhatTheModelCannotShow) {
  const FieldModel model;
  geometry::Points face = model.Vertices(Eigen::VectorXd::Constant(FieldModel::kFields, 0.3));
  const geometry::Points plain = fitting::ExaggeratedFace(model, face, 1);
  face.row(7) += Eigen::RowVector3d(0, 0, 0.01);
  const geometry::Points dented = fitting::ExaggeratedFace(model, face, 1);
  EXPECT_NEAR(dented(7, 2) - plain(7, 2), 0.01, 2e-3);
}

TEST(ExaggeratedFace, LeavesNumbersOfExpression) {
  const FieldModel model;
  Eigen::VectorXd code = Eigen::VectorXd::Zero(FieldModel::kFields);
  code[3] = 1;  // The nose alone.
  const std::array<int, 1> expression = {3};
  const geometry::Points face = model.Vertices(code);
  EXPECT_LT((fitting::ExaggeratedFace(model, face, 2, expression) - face).rowwise().norm().maxCoeff(), 0.05);
}

TEST(ExaggeratedFace, RefusesAnotherTopology) {
  const FieldModel model;
  ExpectError([&] { fitting::ExaggeratedFace(model, geometry::Points::Zero(3, 3), 1); }, "");
}

}  // namespace
}  // namespace daumier::testing
