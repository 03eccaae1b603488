#include "fitting/surface_point_model.h"

#include "fitting/code_handles.h"
#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

Eigen::VectorXd UnevenCode() {
  return Eigen::VectorXd::LinSpaced(FieldModel::kFields, -0.6, 0.9);
}

fitting::TrianglePoint PointOn(int triangle, double b0, double b1) {
  return {triangle, {b0, b1, 1 - b0 - b1}};
}

TEST(SurfacePointModel, PointsAreMeansOfTheirCorners) {
  const FieldModel model(0.1);
  const fitting::SurfacePointModel with_points(model, {PointOn(7, 0.5, 0.2), PointOn(0, 0, 1)});
  const int num_vertices = model.face_template().num_vertices();
  EXPECT_EQ(with_points.num_points(), num_vertices + 2);
  const std::vector<int> points = {num_vertices + 1, 12, num_vertices};
  const Eigen::VectorXd positions = with_points.Positions(UnevenCode(), points);
  const geometry::Points face = model.Vertices(UnevenCode());
  const geometry::Triangles& triangles = model.face_template().triangles;
  const geometry::Points expected =
      (geometry::Points(3, 3) << face.row(triangles(0, 1)), face.row(12),
       0.5 * face.row(triangles(7, 0)) + 0.2 * face.row(triangles(7, 1)) + 0.3 * face.row(triangles(7, 2)))
          .finished();
  EXPECT_LT((Eigen::Map<const geometry::Points>(positions.data(), 3, 3) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SurfacePointModel, DerivativesAreCentralDifferences) {
  const FieldModel model(0.2);
  const fitting::SurfacePointModel with_points(model, {PointOn(7, 0.5, 0.2)});
  const std::vector<int> points = {3, model.face_template().num_vertices()};
  const Eigen::MatrixXd derivative = with_points.Derivative(UnevenCode(), points);
  for (int k = 0; k < FieldModel::kFields; ++k) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(FieldModel::kFields, k);
    const Eigen::VectorXd difference =
        (with_points.Positions(UnevenCode() + step, points) - with_points.Positions(UnevenCode() - step, points)) /
        2e-5;
    EXPECT_LT((derivative.col(k) - difference).norm(), 1e-7);
  }
}

TEST(SurfacePointModel, AHandleOnATriangleReachesItsTarget) {
  const FieldModel model;
  const int nose = model.face_template().annotation.landmarks[30];
  const geometry::Triangles& triangles = model.face_template().triangles;
  int triangle = 0;
  while ((triangles.row(triangle).array() != nose).all()) ++triangle;
  const fitting::SurfacePointModel with_point(model, {PointOn(triangle, 0.2, 0.3)});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  const int point = model.face_template().num_vertices();
  const geometry::Points move = (geometry::Points(1, 3) << 0, 0, 0.8).finished();
  const fitting::HandleEdit edit = fitting::EditByHandles(with_point, zero, {point}, move);
  EXPECT_LE(edit.residual_share, fitting::kHeldShare);
  const std::vector<int> points = {point};
  const Eigen::VectorXd moved = with_point.Positions(edit.code, points) - with_point.Positions(zero, points);
  EXPECT_LE((moved - Eigen::Vector3d(0, 0, 0.8)).norm(), 0.8 * fitting::kHeldShare + 1e-9);
  ExpectError([&] { fitting::EditByHandles(with_point, zero, {point + 1}, move); }, "does not exist");
}

TEST(SurfacePointModel, RefusesWhatIsNoPoint) {
  const FieldModel model;
  ExpectError([&] { fitting::SurfacePointModel(model, {PointOn(1 << 20, 0.2, 0.2)}); }, "triangle 1048576");
  ExpectError([&] { fitting::SurfacePointModel(model, {PointOn(0, 0.8, 0.4)}); }, "none negative");
}

}  // namespace
}  // namespace daumier::testing
