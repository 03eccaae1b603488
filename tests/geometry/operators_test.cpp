#include "geometry/operators.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

namespace daumier::geometry {
namespace {

/// A torus with jittered vertices: no two angles alike, some obtuse.
TriangleMesh JitteredTorus() {
  TriangleMesh mesh = testing::Torus(3, 1, 14, 9);
  Rng rng(5);
  for (double& x : mesh.vertices.reshaped()) x += rng.Uniform(-0.15, 0.15);
  return mesh;
}

Eigen::VectorXd RandomValues(Eigen::Index count) {
  Rng rng(6);
  return Eigen::VectorXd::NullaryExpr(count, [&] { return rng.Normal(); });
}

TEST(CotangentLaplacian, OfOneEquilateralTriangle) {
  const Eigen::Matrix3d laplacian = CotangentLaplacian(testing::EquilateralTriangle());
  const double weight = 0.5 / std::sqrt(3.0);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Constant(-weight);
  expected.diagonal().setConstant(2 * weight);
  EXPECT_LT((laplacian - expected).norm(), 1e-15);
}

TEST(CotangentLaplacian, RaisesEveryCotangentToTheLeastOne) {
  TriangleMesh mesh{Points(3, 3), (Triangles(1, 3) << 0, 1, 2).finished()};
  mesh.vertices << 0, 0, 0, 2, 0, 0, 1, 0.5, 0;  // Cotangents 2, 2, -0.75.
  EXPECT_LT((CornerCotangents(mesh, kUnclamped) - Eigen::RowVector3d(2, 2, -0.75)).norm(), 1e-14);
  EXPECT_LT((CornerCotangents(mesh) - Eigen::RowVector3d(2, 2, 0.02)).norm(), 1e-14);
  EXPECT_NEAR(CotangentLaplacian(mesh).coeff(0, 1), -0.01, 1e-15);
}

TEST(CotangentLaplacian, IsSymmetricPositiveSemidefiniteWithZeroRows) {
  const TriangleMesh mesh = JitteredTorus();
  for (const double least : {kUnclamped, kMinCotangent}) {
    const Eigen::MatrixXd laplacian = CotangentLaplacian(mesh, least);
    EXPECT_EQ(laplacian, laplacian.transpose().eval());
    EXPECT_LT(laplacian.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(laplacian).eigenvalues()[0], -1e-10);
  }
}

TEST(CotangentLaplacian, IsTheDivergenceOfTheGradient) {
  const TriangleMesh mesh = JitteredTorus();
  const SparseMatrix both = Divergence(mesh) * Gradient(mesh);
  EXPECT_LT((both - CotangentLaplacian(mesh, kUnclamped)).norm(), 1e-12);
}

TEST(CotangentLaplacian, WithScalesIsTheDivergenceOfTheScaledGradient) {
  const TriangleMesh mesh = JitteredTorus();
  const Eigen::VectorXd scales = RandomValues(mesh.triangles.rows()).cwiseAbs(),
                        values = RandomValues(mesh.vertices.rows());
  Eigen::VectorXd gradient = Gradient(mesh) * values;
  for (int f = 0; f < scales.size(); ++f) gradient.segment<3>(3 * f) *= scales[f];
  const Eigen::VectorXd expected = Divergence(mesh) * gradient;
  EXPECT_LT((CotangentLaplacian(mesh, kUnclamped, scales) * values - expected).norm(), 1e-11);
  testing::ExpectError([&] { CotangentLaplacian(mesh, kUnclamped, Eigen::VectorXd::Ones(3)); },
                       "3 scales for 252 triangles");
}

TEST(UniformLaplacian, CountsNeighbours) {
  const Eigen::Matrix4d laplacian = UniformLaplacian(testing::FlatSheet(1).triangles, 4);
  EXPECT_EQ(laplacian, (Eigen::Matrix4d() << 3, -1, -1, -1, -1, 2, 0, -1, -1, 0, 2, -1, -1, -1, -1, 3).finished());
}

TEST(Gradient, OfALinearFunctionIsExact) {
  const TriangleMesh sheet = testing::FlatSheet(4);
  const Eigen::VectorXd values = sheet.vertices * Vector3(2, -3, 0);
  const Eigen::VectorXd gradient = Gradient(sheet) * values;
  for (int f = 0; f < sheet.triangles.rows(); ++f) {
    EXPECT_LT((gradient.segment<3>(3 * f) - Vector3(2, -3, 0)).norm(), 1e-12);
  }
}

TEST(Gradient, OfOneEquilateralTriangle) {
  const Eigen::VectorXd hat = Gradient(testing::EquilateralTriangle()) * Vector3(0, 0, 1);
  EXPECT_LT((hat - Vector3(0, 2 / std::sqrt(3.0), 0)).norm(), 1e-14);
}

TEST(Operators, RefuseATriangleWithoutArea) {
  const TriangleMesh mesh{Points::Zero(3, 3), (Triangles(1, 3) << 0, 1, 2).finished()};
  testing::ExpectError([&] { CotangentLaplacian(mesh); }, "triangle 0 has no area");
  testing::ExpectError([&] { Gradient(mesh); }, "triangle 0 has no area");
  testing::ExpectError([&] { Divergence(mesh); }, "triangle 0 has no area");
}

}  // namespace
}  // namespace daumier::geometry
