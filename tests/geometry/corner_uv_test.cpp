#include "geometry/corner_uv.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

PolygonMesh Quad() {
  PolygonMesh mesh{.vertices = Points::Random(4, 3), .offsets = {0, 4}, .corners = {0, 1, 2, 3}};
  mesh.uv = (TextureCoordinates(5, 2) << 0, 0, 9, 9, 1, 0, 1, 1, 0, 1).finished();
  mesh.uv_corners = {4, 0, 2, 3};
  return mesh;
}

TEST(CornerUv, AMeshHasUvAtEveryCornerOrNowhere) {
  PolygonMesh mesh = Quad();
  CheckUv(mesh);
  CheckUv(TriangleMesh{});
  mesh.uv_corners.pop_back();
  ExpectError([&] { CheckUv(mesh); }, "UV of 3 corners, expected 4");
  mesh.uv.resize(0, 2);
  ExpectError([&] { CheckUv(mesh); }, "UV of 3 corners, expected 0");
}

TEST(CornerUv, RowsExistAndAreFinite) {
  PolygonMesh mesh = Quad();
  mesh.uv_corners[2] = 5;
  ExpectError([&] { CheckUv(mesh); }, "row 5 of UV, there are 5");
  mesh.uv_corners[2] = -1;
  ExpectError([&] { CheckUv(mesh); }, "row -1");
  mesh = Quad();
  mesh.uv(1, 0) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { CheckUv(mesh); }, "not finite");
}

TEST(CornerUv, UnusedRowsGoAndCornersKeepTheirUv) {
  PolygonMesh mesh = Quad();
  RemoveUnusedUv(mesh);
  EXPECT_EQ(mesh.uv, (TextureCoordinates(4, 2) << 0, 0, 1, 0, 1, 1, 0, 1).finished());
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{3, 0, 1, 2}));
  TriangleMesh triangles{Points::Random(3, 3), (Triangles(1, 3) << 0, 1, 2).finished(),
                         TextureCoordinates::Random(9, 2), (Triangles(1, 3) << 8, 8, 3).finished()};
  const TextureCoordinates old = triangles.uv;
  RemoveUnusedUv(triangles);
  EXPECT_EQ(triangles.uv, old({3, 8}, Eigen::all));
  EXPECT_EQ(triangles.uv_triangles, (Triangles(1, 3) << 1, 1, 0).finished());
}

}  // namespace
}  // namespace daumier::geometry
