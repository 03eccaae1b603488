#include "geometry/self_intersections.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::geometry {
namespace {

Eigen::Matrix3d Triangle(std::initializer_list<double> numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.begin());
}

const Eigen::Matrix3d kFloor = Triangle({0, 0, 0, 4, 0, 0, 0, 4, 0});

TEST(TrianglesIntersect, HandMadeCases) {
  EXPECT_TRUE(TrianglesIntersect(kFloor, Triangle({1, 1, -1, 1, 1, 1, 2, 1, 1})));     // An edge through the inside.
  EXPECT_TRUE(TrianglesIntersect(kFloor, Triangle({-1, 1, -1, 9, 1, -1, -1, 1, 9})));  // An edge of each through both.
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({1, 1, 1, 2, 1, 2, 1, 2, 3})));     // Above.
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({3, 3, -1, 3, 3, 1, 4, 4, 0})));    // Through the plane, outside.
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({5, -1, -1, 5, -1, 1, 6, -1, 0})));
}

TEST(TrianglesIntersect, TouchingAndLyingInOnePlaneIsNoIntersection) {
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({1, 1, 0, 1, 1, 1, 2, 1, 1})));    // A corner on the inside.
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({1, 0, -1, 1, 0, 1, 1, -3, 0})));  // An edge across a border.
  EXPECT_FALSE(TrianglesIntersect(kFloor, kFloor));
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({1, 1, 0, 5, 1, 0, 1, 5, 0})));
  EXPECT_FALSE(TrianglesIntersect(kFloor, Triangle({1, 1, -1, 1, 1, 0, 1, 1, 1})));  // No area.
}

/// Whether an edge of one triangle crosses the inside of the other.
bool EdgePierces(const Eigen::Matrix3d& edges, const Eigen::Matrix3d& triangle) {
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix3d system;
    const Vector3 from = edges.row(k), way = edges.row((k + 1) % 3) - edges.row(k);
    system << (triangle.row(1) - triangle.row(0)).transpose(), (triangle.row(2) - triangle.row(0)).transpose(), -way;
    const Vector3 uvt = system.fullPivLu().solve(from - triangle.row(0).transpose());
    if (uvt.minCoeff() > 0 && uvt[0] + uvt[1] < 1 && uvt[2] < 1) return true;
  }
  return false;
}

TEST(TrianglesIntersect, AgreesWithEdgesThroughTriangles) {
  Rng rng(9);
  int num_intersecting = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Eigen::Matrix3d a, b;
    for (Eigen::Matrix3d* triangle : {&a, &b}) {
      for (double& number : triangle->reshaped()) number = rng.Normal();
    }
    const bool expected = EdgePierces(a, b) || EdgePierces(b, a);
    num_intersecting += expected;
    EXPECT_EQ(TrianglesIntersect(a, b), expected);
    EXPECT_EQ(TrianglesIntersect(b, a), expected);
  }
  EXPECT_GT(num_intersecting, 100);
}

TEST(SelfIntersections, NoneOnCleanSurfaces) {
  EXPECT_TRUE(SelfIntersections(testing::Sphere(1, 3)).empty());
  EXPECT_TRUE(SelfIntersections(testing::Torus(3, 1, 20, 12)).empty());
  EXPECT_TRUE(SelfIntersections(testing::FlatSheet(5)).empty());
}

TEST(SelfIntersections, ArePairsOfLookingAtAllPairs) {
  // Two spheres through each other.
  const TriangleMesh sphere = testing::Sphere(1, 2);
  const int num_vertices = static_cast<int>(sphere.vertices.rows());
  TriangleMesh mesh{Points(2 * num_vertices, 3), Triangles(2 * sphere.triangles.rows(), 3)};
  mesh.vertices << sphere.vertices, sphere.vertices.rowwise() + Eigen::RowVector3d(0.7, 0.31, 0.43);
  mesh.triangles << sphere.triangles, sphere.triangles.array() + num_vertices;
  std::vector<TrianglePair> expected;
  const auto corners = [&](int f) -> Eigen::Matrix3d {
    return mesh.vertices(Eigen::Vector3i(mesh.triangles.row(f)), Eigen::all);
  };
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int g = f + 1; g < mesh.triangles.rows(); ++g) {
      bool is_near = false;
      for (const int v : mesh.triangles.row(f)) is_near = is_near || (mesh.triangles.row(g).array() == v).any();
      if (!is_near && TrianglesIntersect(corners(f), corners(g))) expected.push_back({f, g});
    }
  }
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(SelfIntersections(mesh), expected);
}

}  // namespace
}  // namespace daumier::geometry
