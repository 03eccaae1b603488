#include "geometry/closed_surface.h"

#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::geometry {
namespace {

/// With a corner at the origin and edges of length 1 along the axes.
TriangleMesh UnitTetrahedron() {
  TriangleMesh mesh{Points(4, 3), Triangles(4, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return mesh;
}

TEST(ClosedSurface, VolumesAreThoseOfTheSolids) {
  TriangleMesh tetrahedron = UnitTetrahedron();
  EXPECT_NEAR(EnclosedVolume(tetrahedron), 1.0 / 6, 1e-15);
  tetrahedron.vertices.rowwise() += Eigen::RowVector3d(5, -3, 2);
  EXPECT_NEAR(EnclosedVolume(tetrahedron), 1.0 / 6, 1e-12) << "wherever it is";
  tetrahedron.triangles.col(1).swap(tetrahedron.triangles.col(2));
  EXPECT_NEAR(EnclosedVolume(tetrahedron), -1.0 / 6, 1e-12) << "inside out";
  const double pi = std::numbers::pi;
  EXPECT_NEAR(EnclosedVolume(testing::Torus(2, 0.5, 200, 100)), 2 * pi * pi * 2 * 0.25, 0.01);
}

TEST(ClosedSurface, IsClosedIfEachEdgeHasTwoTrianglesInOppositeDirections) {
  Triangles triangles = UnitTetrahedron().triangles;
  EXPECT_TRUE(IsClosed(triangles));
  EXPECT_FALSE(IsClosed(triangles.topRows(3)));
  triangles.row(0).reverseInPlace();
  EXPECT_FALSE(IsClosed(triangles));
}

TEST(ClosedSurface, CutsTwoSolidsApartThatShareAnEdge) {
  TriangleMesh both = Joined({UnitTetrahedron(), UnitTetrahedron()});
  both.vertices.bottomRows(4).leftCols(2) *= -1;  // Turned about z.
  both.triangles = both.triangles.unaryExpr([](int v) { return v == 4 ? 0 : v == 7 ? 3 : v; }).eval();
  const ManifoldSurface cut = CutToManifold(both);
  EXPECT_EQ(cut.num_bad_edges, 1);
  EXPECT_TRUE(IsClosed(cut.mesh.triangles));
  EXPECT_NO_THROW(CheckManifold(cut.mesh.triangles, int(cut.mesh.vertices.rows())));
  EXPECT_EQ(ConnectedParts(cut.mesh).size(), 2u);
  EXPECT_NEAR(EnclosedVolume(cut.mesh), 2.0 / 6, 1e-15);
}

TEST(ClosedSurface, CutsAFinOffAndFansApart) {
  TriangleMesh solid = UnitTetrahedron();
  solid.vertices.conservativeResize(5, Eigen::NoChange);
  solid.vertices.row(4) << -1, -1, 0.5;
  solid.triangles.conservativeResize(5, Eigen::NoChange);
  solid.triangles.row(4) << 0, 3, 4;
  const ManifoldSurface cut = CutToManifold(solid);
  EXPECT_EQ(cut.num_bad_edges, 1);
  const std::vector<TriangleMesh> parts = ConnectedParts(cut.mesh);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_TRUE(IsClosed(parts[0].triangles)) << "the solid";
  Triangles bow(2, 3);
  bow << 0, 1, 2, 0, 3, 4;
  const ManifoldSurface apart = CutToManifold({Points::Random(5, 3), bow});
  EXPECT_EQ(apart.num_bad_edges, 0);
  EXPECT_EQ(apart.mesh.vertices.rows(), 6);
}

TEST(ClosedSurface, AFilledHoleClosesTheSurface) {
  TriangleMesh open = testing::Sphere(1, 2);
  open.triangles = open.triangles.topRows(open.triangles.rows() - 1).eval();
  const auto loops = BoundaryLoops(open.triangles, int(open.vertices.rows()));
  ASSERT_EQ(loops.size(), 1u);
  FillHole(loops[0], open);
  EXPECT_TRUE(IsClosed(open.triangles));
  EXPECT_NEAR(EnclosedVolume(open), EnclosedVolume(testing::Sphere(1, 2)), 1e-12) << "a flat hole";
}

TEST(ClosedSurface, RefusesCornersThatAreNotThere) {
  Triangles broken(1, 3);
  broken << 0, 1, 5;
  testing::ExpectError([&] { CutToManifold({Points::Zero(3, 3), broken}); }, "triangle 0 names a vertex");
  broken << 0, 1, 1;
  testing::ExpectError([&] { CutToManifold({Points::Zero(3, 3), broken}); }, "triangle 0 has a vertex twice");
}

}  // namespace
}  // namespace daumier::geometry
