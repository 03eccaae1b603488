#include "geometry/detail_energy.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::geometry {
namespace {

/// A box-like slab: a torus flattened to a thickness of 0.3.
TriangleMesh Slab() {
  TriangleMesh mesh = testing::Torus(3, 1, 24, 12);
  mesh.vertices.col(2) *= 0.15;
  return mesh;
}

TEST(DetailEnergy, IsLeastWhereTheMeshIsMovedByASimilarity) {
  const TriangleMesh mesh = Slab();
  const DetailEnergy energy(mesh, {});
  ASSERT_FALSE(energy.ties().empty());
  const Eigen::Matrix3d map = 1.8 * Eigen::AngleAxisd(2.5, Vector3(1, -2, 3).normalized()).toRotationMatrix();
  const Points moved = (mesh.vertices * map.transpose()).rowwise() + Eigen::RowVector3d(4, 5, 6);
  EXPECT_LT((energy.matrix() * moved - energy.Pull(moved)).norm(), 1e-10);
}

TEST(DetailEnergy, ResistsScalesBeyondTheLimit) {
  const TriangleMesh mesh = Slab();
  const DetailEnergy energy(mesh, {.max_scale = 2});
  const Points moved = 3 * mesh.vertices;
  EXPECT_LT((energy.matrix() * moved - 1.5 * energy.Pull(moved)).norm(), 1e-10);
}

TEST(DetailEnergy, TiesJoinTheTwoSidesOfABody) {
  const TriangleMesh mesh = Slab();
  const DetailEnergy energy(mesh, {});
  for (const auto& [i, j] : energy.ties()) {
    const Vector3 way = mesh.vertices.row(j) - mesh.vertices.row(i);
    EXPECT_LT(way.norm(), 1);
    EXPECT_LT(mesh.vertices(i, 2) * mesh.vertices(j, 2), 0);
  }
  // Two sheets that face each other through the air are not tied; those that turn their backs to each other are.
  const auto sheets = [](double distance) {
    const TriangleMesh sheet = testing::FlatSheet(3);
    TriangleMesh both{Points(32, 3), Triangles(36, 3)};
    both.vertices << sheet.vertices, sheet.vertices.rowwise() + Eigen::RowVector3d(0, 0, distance);
    both.triangles << sheet.triangles.rowwise().reverse(), sheet.triangles.array() + 16;
    return both;
  };
  EXPECT_EQ(DetailEnergy(sheets(0.1), {}).ties().size(), 16u);
  EXPECT_TRUE(DetailEnergy(sheets(-0.1), {}).ties().empty());
  EXPECT_TRUE(DetailEnergy(sheets(0.1), {.max_thickness = 0.05}).ties().empty());
}

TEST(DetailEnergy, RefusesLooseVerticesAndOtherSizes) {
  TriangleMesh mesh = testing::FlatSheet(2);
  const DetailEnergy energy(mesh, {});
  testing::ExpectError([&] { energy.Pull(Points(4, 3)); }, "4 vertices, expected 9");
  mesh.vertices.conservativeResize(10, 3);
  mesh.vertices.row(9).setZero();
  testing::ExpectError([&] { DetailEnergy(mesh, {}); }, "vertex 9 belongs to no triangle");
}

}  // namespace
}  // namespace daumier::geometry
