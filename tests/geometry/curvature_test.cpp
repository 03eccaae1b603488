#include "geometry/curvature.h"

#include "geometry/normals.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

TEST(GaussianCurvature, OfASphereIsOneOverItsRadiusSquared) {
  const Eigen::VectorXd curvature = GaussianCurvature(testing::Sphere(2, 4));
  EXPECT_LT((curvature.array() - 0.25).abs().maxCoeff(), 0.01);
}

TEST(GaussianCurvature, OfATorusChangesSign) {
  const int across = 24;
  const Eigen::VectorXd curvature = GaussianCurvature(testing::Torus(3, 1, 72, across));
  EXPECT_NEAR(curvature[0], 1.0 / (3 + 1), 0.01) << "outer equator: cos b / (r (R + r cos b))";
  EXPECT_NEAR(curvature[across / 2], -1.0 / (3 - 1), 0.02) << "inner equator";
}

TEST(GaussianCurvature, IsZeroOnBoundariesAndFlatSheets) {
  EXPECT_LT(GaussianCurvature(testing::FlatSheet(4)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(AngleDefects, SumToTheEulerCharacteristic) {
  EXPECT_NEAR(AngleDefects(testing::Sphere(2, 2)).sum(), 2 * kTwoPi, 1e-10);
  EXPECT_NEAR(AngleDefects(testing::Torus(3, 1, 9, 7)).sum(), 0, 1e-10);
  EXPECT_NEAR(AngleDefects(testing::Sheet(5, [](double x, double y) { return std::sin(3 * x) * y; })).sum(), kTwoPi,
              1e-10);
}

TEST(AngleDefects, OfASquareAreItsCorners) {
  const Eigen::VectorXd defects = AngleDefects(testing::FlatSheet(2));
  EXPECT_NEAR(defects[0], kTwoPi / 4, 1e-12);
  EXPECT_NEAR(defects[1], 0, 1e-12);
  EXPECT_NEAR(defects[4], 0, 1e-12);
}

TEST(SmoothOverRings, KeepsConstantsAndShrinksTheRange) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  const int num_vertices = static_cast<int>(sphere.vertices.rows());
  const Adjacency neighbours = VertexNeighbours(sphere.triangles, num_vertices);
  const Eigen::VectorXd areas = VertexAreas(sphere), ones = Eigen::VectorXd::Ones(num_vertices);
  EXPECT_LT((SmoothOverRings(ones, areas, neighbours, 5) - ones).cwiseAbs().maxCoeff(), 1e-14);
  const Eigen::VectorXd x = sphere.vertices.col(0);
  EXPECT_EQ(SmoothOverRings(x, areas, neighbours, 0), x);
  EXPECT_LT(SmoothOverRings(x, areas, neighbours, 3).maxCoeff(), x.maxCoeff());
  testing::ExpectError([&] { SmoothOverRings(x.head(3), areas, neighbours, 1); }, "3 values");
}

TEST(SmoothOverRings, WeighsByArea) {
  const Adjacency neighbours = VertexNeighbours(testing::EquilateralTriangle().triangles, 3);
  const Eigen::VectorXd smooth = SmoothOverRings(Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(3, 1, 2), neighbours, 1);
  EXPECT_LT((smooth.array() - 2).abs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace daumier::geometry
