#include "geometry/weld.h"

#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

namespace daumier::geometry {
namespace {

/// Every triangle with corners of its own, each moved by up to `noise`.
TriangleMesh Split(const TriangleMesh& mesh, double noise) {
  TriangleMesh split{Points(mesh.triangles.size(), 3), Triangles(mesh.triangles.rows(), 3)};
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    split.vertices.row(i) = mesh.vertices.row(mesh.triangles.data()[i]);
    split.triangles.data()[i] = static_cast<int>(i);
  }
  split.vertices += noise * Points::Random(split.vertices.rows(), 3);
  return split;
}

TEST(WeldByPlace, GivesTheLowestVertexAtAPlace) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Points points =
      (Points(7, 3) << 0, 0, 0, 1, 0, 0, -0.0, 0, 0, 1, 0, 1e-9, kNan, 0, 0, kNan, 0, 0, 1, 0, 1e-3).finished();
  EXPECT_EQ(WeldByPlace(points, 0), (std::vector<int>{0, 1, 0, 3, 4, 5, 6}));
  EXPECT_EQ(WeldByPlace(points, 1e-8), (std::vector<int>{0, 1, 0, 1, 4, 5, 6}));
  EXPECT_EQ(WeldByPlace(points, 1e-2), (std::vector<int>{0, 1, 0, 1, 4, 5, 1}));
  testing::ExpectError([&] { WeldByPlace(points, -1); }, "within -1 cm");
}

TEST(WeldByPlace, AgreesWithAllPairs) {
  const Points points = Points::Random(400, 3);
  for (const double tolerance : {0.02, 0.2, 0.9}) {
    const std::vector<int> places = WeldByPlace(points, tolerance);
    for (int v = 0; v < points.rows(); ++v) {
      int expected = v;
      for (int u = v - 1; u >= 0; --u) {
        if (places[u] == u && (points.row(u) - points.row(v)).norm() <= tolerance) expected = u;
      }
      EXPECT_LE((points.row(places[v]) - points.row(v)).norm(), tolerance);
      EXPECT_EQ(places[v] == v, expected == v) << v << ": joined iff an earlier one represents the place";
    }
  }
}

TEST(WeldByPlace, IsQuickWhereAllVerticesLieInOnePoint) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<int> places = WeldByPlace(Points::Ones(100'000, 3), 1e-6);
  EXPECT_EQ(*std::max_element(places.begin(), places.end()), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(WeldTolerance, IsOfTheSizeOfTheMeshWithoutAFewFarVertices) {
  Points points = Points::Zero(101, 3);
  for (int v = 0; v <= 100; ++v) points(v, 1) = 0.02 * v;
  EXPECT_NEAR(WeldTolerance(points), 1e-6, 1e-12) << "the middle half of 2";
  points.row(100) << 1e9, 1e9, -1e9;
  points.row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(WeldTolerance(points), 1e-6, 1e-7);
  EXPECT_EQ(WeldTolerance(Points(0, 3)), 0);
}

TEST(WeldedSurface, MakesSplitTrianglesOneSurfaceAgain) {
  const TriangleMesh torus = testing::Torus(3, 1, 12, 8);
  for (const double noise : {0.0, 1e-7}) {
    const TriangleMesh split = Split(torus, noise), welded = WeldedSurface(split, WeldTolerance(split.vertices));
    EXPECT_EQ(welded.vertices.rows(), torus.vertices.rows());
    EXPECT_EQ(welded.triangles.rows(), torus.triangles.rows());
    EXPECT_EQ(EulerCharacteristic(welded.triangles), 0);
    EXPECT_NO_THROW(CheckManifold(welded.triangles, int(welded.vertices.rows())));
  }
}

TEST(WeldedSurface, KeepsAMeshThatHasNothingToWeld) {
  const TriangleMesh torus = testing::Torus(3, 1, 12, 8), welded = WeldedSurface(torus, WeldTolerance(torus.vertices));
  EXPECT_EQ(welded.vertices, torus.vertices);
  EXPECT_EQ(welded.triangles, torus.triangles);
}

TEST(WeldedSurface, DropsRepeatedTrianglesAndThoseWithoutThreePlaces) {
  const Points points = (Points(6, 3) << 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 5, 5, 5).finished();
  const Triangles triangles = (Triangles(5, 3) << 1, 2, 3, 4, 3, 1, 3, 2, 1, 1, 2, 4, 2, 2, 3).finished();
  const TriangleMesh welded = WeldedSurface({points, triangles}, 1e-6);
  EXPECT_EQ(welded.triangles, (Triangles(1, 3) << 0, 1, 2).finished());
  EXPECT_EQ(welded.vertices, points.middleRows(1, 3)) << "vertices without a triangle are removed";
}

}  // namespace
}  // namespace daumier::geometry
