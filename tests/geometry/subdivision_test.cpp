#include "geometry/subdivision.h"

#include "geometry/normals.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::geometry {
namespace {

/// Closed, without handles, counter-clockwise from outside.
TriangleMesh Tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return mesh;
}

TEST(Subdivision, OfOneTriangleWorkedOutByHand) {
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  const Subdivision once = SubdivideOnce(triangle, 3);
  EXPECT_EQ(once.edges, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {0, 2}}));
  Triangles expected(4, 3);
  expected << 0, 3, 5, 1, 4, 3, 2, 5, 4, 3, 4, 5;
  EXPECT_EQ(once.triangles, expected);
}

// V' = V + E, and E = 3V - 6 on a closed surface without handles: 4 -> 10 -> 34 -> 130.
TEST(Subdivision, AClosedSurfaceWithoutHandlesGetsFourTimesItsVerticesLessSix) {
  const TriangleMesh mesh = Tetrahedron();
  int expected = 4;
  for (const int times : {0, 1, 2, 3}) {
    const Subdivider subdivider(mesh.triangles, 4, times);
    EXPECT_EQ(subdivider.num_vertices(), expected);
    EXPECT_EQ(subdivider.triangles().rows(), 4 << (2 * times));
    expected = 4 * expected - 6;
  }
  // The template of [Jung et al. 2022], 11,551 vertices, three times: 739,138, not the printed 739,183.
  EXPECT_EQ(4 * (4 * (4 * 11551 - 6) - 6) - 6, 739138);
}

TEST(Subdivision, KeepsTheSurfaceAndItsOrientation) {
  const TriangleMesh mesh = Tetrahedron();
  const Subdivider subdivider(mesh.triangles, 4, 2);
  const TriangleMesh fine{subdivider.Apply(mesh.vertices), subdivider.triangles()};
  EXPECT_EQ(fine.vertices.topRows(4), mesh.vertices);
  EXPECT_NEAR(TriangleAreas(fine).sum(), TriangleAreas(mesh).sum(), 1e-12);
  const Points coarse_normals = TriangleNormals(mesh), fine_normals = TriangleNormals(fine);
  for (Eigen::Index t = 0; t < fine.triangles.rows(); ++t)
    EXPECT_LT((fine_normals.row(t) - coarse_normals.row(t / 16)).norm(), 1e-12);
}

TEST(Subdivision, HasNoTwoVerticesInOnePlace) {
  const TriangleMesh mesh = Tetrahedron();
  const Points fine = Subdivider(mesh.triangles, 4, 3).Apply(mesh.vertices);
  std::set<std::array<double, 3>> places;
  for (Eigen::Index v = 0; v < fine.rows(); ++v) places.insert({fine(v, 0), fine(v, 1), fine(v, 2)});
  EXPECT_EQ(Eigen::Index(places.size()), fine.rows());
}

TEST(Subdivision, UvStaysLinearOnEachOldTriangle) {
  // UV of each triangle is an affine map of its positions, another one for each, so that every edge is a seam.
  TriangleMesh mesh = Tetrahedron();
  mesh.uv.resize(12, 2);
  mesh.uv_triangles.resize(4, 3);
  const auto uv_of = [&](Eigen::Index triangle, const Eigen::RowVector3d& p) {
    const double shift = 2.0 * double(triangle);
    return Eigen::RowVector2d(p.x() - 0.5 * p.z() + shift, 0.25 * p.y() + p.z() - shift);
  };
  for (int t = 0; t < 4; ++t) {
    for (int k = 0; k < 3; ++k) {
      mesh.uv_triangles(t, k) = 3 * t + k;
      mesh.uv.row(3 * t + k) = uv_of(t, mesh.vertices.row(mesh.triangles(t, k)));
    }
  }
  const TriangleMesh fine = Subdivide(mesh, 2);
  EXPECT_EQ(fine.triangles, Subdivider(mesh.triangles, 4, 2).triangles());
  ASSERT_EQ(fine.uv_triangles.rows(), fine.triangles.rows());
  EXPECT_EQ(fine.uv.rows(), 4 * 15) << "15 vertices on each old triangle";
  for (Eigen::Index t = 0; t < fine.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector2d expected = uv_of(t / 16, fine.vertices.row(fine.triangles(t, k)));
      EXPECT_LT((fine.uv.row(fine.uv_triangles(t, k)) - expected).norm(), 1e-12);
    }
  }
  mesh.uv.resize(0, 2);
  mesh.uv_triangles.resize(0, 3);
  EXPECT_FALSE(Subdivide(mesh, 1).has_uv());
}

TEST(Subdivision, RefusesWhatDoesNotFit) {
  Triangles triangle(1, 3);
  triangle << 0, 1, 3;
  testing::ExpectError([&] { SubdivideOnce(triangle, 3); }, "corners 0, 1, 3 of 3 vertices");
  testing::ExpectError([&] { Subdivider(triangle, 4, 1).Apply(Points::Zero(3, 3)); }, "vertices are 3, expected 4");
}

}  // namespace
}  // namespace daumier::geometry
