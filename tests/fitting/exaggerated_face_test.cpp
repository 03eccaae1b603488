#include "fitting/exaggerated_face.h"

#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace daumier::testing {
namespace {

TEST(ExaggeratedFace, MultipliesTheCodeOfAFaceOfTheModel) {
  const FieldModel model;
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.6, -0.5, 0.3, 1.2, 0.4, 0.4;  // Both sides of the jaw alike.
  const geometry::Points face = model.Vertices(code), expected = model.Vertices(1.5 * code);
  const geometry::Points exaggerated = fitting::Exaggerate(model, face, 0.5).vertices;
  const faces::FaceTemplate& of_model = model.face_template();
  const geometry::Points rim = of_model.neutral(of_model.annotation.regions.at("neck_border"), Eigen::all);
  int num_compared = 0;
  for (Eigen::Index v = 0; v < face.rows(); ++v) {
    if ((rim.rowwise() - of_model.neutral.row(v)).rowwise().norm().minCoeff() < 4) continue;
    ++num_compared;
    EXPECT_LT((exaggerated - expected).row(v).norm(), 0.05) << v;  // The code's ridge makes it shorter by little.
  }
  EXPECT_GT(num_compared, 50);
  EXPECT_EQ(fitting::Exaggerate(model, face, 0).vertices, face);
}

TEST(ExaggeratedFace, KeepsWhatTheModelCannotShow) {
  const FieldModel model;
  geometry::Points face = model.Vertices(Eigen::VectorXd::Constant(FieldModel::kFields, 0.3));
  const geometry::Points plain = fitting::Exaggerate(model, face, 1).vertices;
  face.row(7) += Eigen::RowVector3d(0, 0, 0.01);
  const geometry::Points dented = fitting::Exaggerate(model, face, 1).vertices;
  EXPECT_NEAR(dented(7, 2) - plain(7, 2), 0.01, 2e-3);
}

TEST(ExaggeratedFace, LeavesNumbersOfExpression) {
  const FieldModel model;
  Eigen::VectorXd code = Eigen::VectorXd::Zero(FieldModel::kFields);
  code[3] = 1;  // The nose alone.
  const std::array<int, 1> expression = {3};
  const geometry::Points face = model.Vertices(code);
  EXPECT_LT((fitting::Exaggerate(model, face, 2, expression).vertices - face).rowwise().norm().maxCoeff(), 0.05);
}

TEST(ExaggeratedFace, MovesTheNecksBorderAsOnePieceAndBothSidesAlike) {
  const FieldModel model;
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.6, -0.5, 0.3, 1.2, -0.7, 0.4;  // One side of the jaw more than the other.
  const geometry::Points face = model.Vertices(code);
  const geometry::Points moves = fitting::Exaggerate(model, face, 1).vertices - face;
  const faces::Annotation& annotation = model.face_template().annotation;
  for (size_t v = 0; v < annotation.mirror.size(); ++v) {
    const Eigen::RowVector3d mirrored = moves.row(annotation.mirror[v]);
    EXPECT_NEAR(moves(Eigen::Index(v), 0), -mirrored.x(), 1e-9) << v;
    EXPECT_NEAR(moves(Eigen::Index(v), 1), mirrored.y(), 1e-9) << v;
  }
  const geometry::Points rim = moves(annotation.regions.at("neck_border"), Eigen::all);
  EXPECT_LT((rim.rowwise() - rim.row(0)).norm(), 1e-9);
}

TEST(ExaggeratedFace, StatesTheLengthOfItsCode) {
  const FieldModel model;
  const geometry::Points face = model.Vertices(Eigen::VectorXd::Constant(FieldModel::kFields, 0.5));
  const double plain = fitting::Exaggerate(model, face, 0).radius;
  EXPECT_NEAR(plain, 0.5 * std::sqrt(6.0), 0.02);
  EXPECT_NEAR(fitting::Exaggerate(model, face, 1.5).radius, 2.5 * plain, 1e-9);
}

TEST(ExaggeratedFace, RefusesAnotherTopology) {
  const FieldModel model;
  ExpectError([&] { fitting::Exaggerate(model, geometry::Points::Zero(3, 3), 1); }, "");
}

}  // namespace
}  // namespace daumier::testing
