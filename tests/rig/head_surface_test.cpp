#include "rig/head_surface.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// Two triangles that share an edge whose vertices are split, a vertex that no triangle uses, and a triangle of its own.
geometry::TriangleMesh SplitMesh() {
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(10, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 9, 9, 9, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  mesh.triangles.resize(3, 3);
  mesh.triangles << 0, 1, 2, 3, 4, 5, 7, 8, 9;
  return mesh;
}

TEST(HeadSurface, HasOneVertexAPlace) {
  const HeadSurface surface = MakeHeadSurface(SplitMesh());
  EXPECT_EQ(surface.places, (std::vector<int>{0, 1, 2, 1, 3, 2, -1, 4, 5, 6}));
  EXPECT_EQ(surface.num_places(), 7);
  EXPECT_EQ(surface.num_components(), 2);
  EXPECT_EQ(surface.components, (std::vector<int>{0, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(surface.mesh.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
  EXPECT_EQ(surface.normals.row(1), Eigen::RowVector3d(0, 0, 1));
}

TEST(HeadSurface, MovesVerticesAsTheirPlaces) {
  const HeadSurface surface = MakeHeadSurface(SplitMesh());
  Eigen::MatrixXf of_places = Eigen::MatrixXf::Zero(21, 2);
  of_places(3 * 1 + 2, 1) = 4;
  const Eigen::MatrixXf offsets = OffsetsOfVertices(surface, of_places);
  ASSERT_EQ(offsets.rows(), 30);
  EXPECT_EQ(offsets(3 * 1 + 2, 1), 4);
  EXPECT_EQ(offsets(3 * 3 + 2, 1), 4) << "the same place";
  EXPECT_EQ(offsets.sum(), 8);
}

TEST(HeadSurface, IsRefusedWithoutTriangles) {
  geometry::TriangleMesh mesh = SplitMesh();
  mesh.triangles.resize(1, 3);
  mesh.triangles << 1, 3, 0;
  testing::ExpectError([&] { MakeHeadSurface(mesh); }, "no triangle whose corners lie apart");
  mesh.triangles << 1, 12, 0;
  testing::ExpectError([&] { MakeHeadSurface(mesh); }, "triangle 0 names vertex 12");
}

}  // namespace
}  // namespace daumier::rig
