#include "geometry/submesh.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(Submesh, KeepsTheFacesBetweenKeptVertices) {
  const TriangleMesh sheet = testing::FlatSheet(2);
  const VertexMap map = MapKept({4, 3, 1, 0, 0, 8}, 9);
  EXPECT_EQ(map.old_from_new, (std::vector<int>{0, 1, 3, 4, 8}));
  EXPECT_EQ(map.new_from_old, (std::vector<int>{0, 1, -1, 2, 3, -1, -1, -1, 4}));
  const TriangleMesh part = Submesh(sheet, map);
  EXPECT_EQ(part.triangles, (Triangles(2, 3) << 0, 1, 3, 0, 3, 2).finished());
  EXPECT_EQ(part.vertices.row(4), sheet.vertices.row(8));
  EXPECT_EQ(SelectVertices({8, 2, 0}, map), (std::vector<int>{4, 0}));
}

TEST(Submesh, OfPolygonsKeepsTheirCornersInOrder) {
  PolygonMesh mesh;
  mesh.vertices = Points::Random(5, 3);
  mesh.offsets = {0, 4, 7};
  mesh.corners = {0, 1, 3, 4, 1, 2, 3};
  const PolygonMesh part = Submesh(mesh, MapKept({0, 1, 3, 4}, 5));
  EXPECT_EQ(part.offsets, (std::vector<int>{0, 4}));
  EXPECT_EQ(part.corners, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Submesh, KeepsTheUvThatKeptCornersUse) {
  PolygonMesh mesh;
  mesh.vertices = Points::Random(5, 3);
  mesh.offsets = {0, 3, 6};
  mesh.corners = {0, 1, 2, 2, 1, 4};
  mesh.uv = TextureCoordinates::Random(6, 2);
  mesh.uv_corners = {0, 3, 1, 2, 5, 4};
  const PolygonMesh part = Submesh(mesh, MapKept({1, 2, 4}, 5));
  EXPECT_EQ(part.corners, (std::vector<int>{1, 0, 2}));
  EXPECT_EQ(part.uv_corners, (std::vector<int>{0, 2, 1}));
  EXPECT_EQ(part.uv, mesh.uv({2, 4, 5}, Eigen::all));

  const TriangleMesh triangles{mesh.vertices, (Triangles(2, 3) << 0, 1, 2, 2, 1, 4).finished(), mesh.uv,
                               (Triangles(2, 3) << 0, 3, 1, 2, 5, 4).finished()};
  const TriangleMesh kept = Submesh(triangles, MapKept({1, 2, 4}, 5));
  EXPECT_EQ(kept.triangles, (Triangles(1, 3) << 1, 0, 2).finished());
  EXPECT_EQ(kept.uv_triangles, (Triangles(1, 3) << 0, 2, 1).finished());
  EXPECT_EQ(kept.uv, part.uv);
  EXPECT_FALSE(Submesh(mesh, MapKept({0, 1, 4}, 5)).has_uv()) << "no face is left";
}

TEST(Submesh, RefusesAVertexOutOfRange) {
  testing::ExpectError([] { MapKept({3}, 3); }, "vertex 3 is out of range");
}

}  // namespace
}  // namespace daumier::geometry
