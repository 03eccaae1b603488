#include "geometry/normals.h"

#include "tests/geometry/shapes.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(Normals, OfOneEquilateralTriangle) {
  const TriangleMesh mesh = testing::EquilateralTriangle();
  const double area = std::sqrt(3.0) / 4;
  EXPECT_NEAR(TriangleAreas(mesh)[0], area, 1e-15);
  EXPECT_NEAR(AreaNormals(mesh)(0, 2), 2 * area, 1e-15);
  EXPECT_LT((TriangleNormals(mesh).row(0) - Eigen::RowVector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((VertexNormals(mesh).rowwise() - Eigen::RowVector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((VertexAreas(mesh).array() - area / 3).abs().maxCoeff(), 1e-15);
}

TEST(Normals, OfVerticesAreExactOnASphere) {
  const TriangleMesh sphere = testing::Sphere(3, 3);
  EXPECT_LT((VertexNormals(sphere) - sphere.vertices / 3).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Normals, WithoutAreaAreZero) {
  const TriangleMesh mesh{Points::Zero(3, 3), (Triangles(1, 3) << 0, 1, 2).finished()};
  EXPECT_EQ(TriangleNormals(mesh).norm(), 0);
  EXPECT_EQ(VertexNormals(mesh).norm(), 0);
  EXPECT_EQ(CornerAreas(mesh).norm(), 0);
}

TEST(Areas, OfARightTriangleAreItsVoronoiRegions) {
  TriangleMesh mesh = testing::FlatSheet(1);
  mesh.triangles.conservativeResize(1, 3);
  const Points corners = CornerAreas(mesh);  // The right angle is at corner 1.
  EXPECT_NEAR(corners(0, 0), 0.125, 1e-15);
  EXPECT_NEAR(corners(0, 1), 0.25, 1e-15);
  EXPECT_NEAR(corners(0, 2), 0.125, 1e-15);
}

TEST(Areas, OfCornersSumToTheTriangleEvenIfObtuse) {
  TriangleMesh mesh{Points(3, 3), (Triangles(1, 3) << 2, 0, 1).finished()};
  mesh.vertices << 0, 0, 0, 4, 0, 0, 1, 0.3, 0;
  const Points corners = CornerAreas(mesh);
  EXPECT_GT(corners.minCoeff(), 0);
  EXPECT_NEAR(corners.sum(), 0.6, 1e-14);
  const TriangleMesh torus = testing::Torus(3, 1, 20, 9);
  EXPECT_NEAR(VertexAreas(torus).sum(), TriangleAreas(torus).sum(), 1e-10);
}

TEST(Transfer, BetweenVerticesAndTrianglesKeepsConstants) {
  const TriangleMesh mesh = testing::Sphere(1, 2);
  const Eigen::VectorXd on_vertices = Eigen::VectorXd::Constant(mesh.vertices.rows(), 2.5);
  const Eigen::VectorXd on_triangles = VerticesToTriangles(mesh.triangles, on_vertices);
  EXPECT_LT((on_triangles.array() - 2.5).abs().maxCoeff(), 1e-14);
  EXPECT_LT((TrianglesToVertices(mesh, on_triangles) - on_vertices).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace daumier::geometry
