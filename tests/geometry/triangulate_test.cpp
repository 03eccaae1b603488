#include "geometry/triangulate.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

PolygonMesh OnePolygon(std::initializer_list<std::array<double, 2>> corners) {
  PolygonMesh mesh;
  mesh.vertices = Points::Zero(static_cast<int>(corners.size()), 3);
  for (const auto& [x, y] : corners) {
    mesh.vertices.row(static_cast<int>(mesh.corners.size())) << x, y, 0;
    mesh.corners.push_back(static_cast<int>(mesh.corners.size()));
  }
  mesh.offsets.push_back(static_cast<int>(corners.size()));
  return mesh;
}

TEST(Triangulate, CutsAQuadAlongItsShorterDiagonal) {
  Triangles expected(2, 3);
  expected << 0, 1, 2, 0, 2, 3;
  EXPECT_EQ(Triangulate(OnePolygon({{0, 0}, {2, -1}, {1, 1}, {-1, 2}})), expected);
  expected << 1, 2, 3, 1, 3, 0;
  EXPECT_EQ(Triangulate(OnePolygon({{-1, -1}, {1, 0}, {2, 2}, {0, 1}})), expected);
}

TEST(Triangulate, CutsASquareAtItsHighestCorner) {
  Triangles expected(2, 3);
  expected << 2, 3, 0, 2, 0, 1;
  EXPECT_EQ(Triangulate(OnePolygon({{0, -1}, {1, 0}, {0, 1}, {-1, 0}})), expected);
}

TEST(Triangulate, KeepsTrianglesAndFansPentagons) {
  EXPECT_EQ(Triangulate(OnePolygon({{0, 0}, {1, 0}, {0, 1}})), (Triangles(1, 3) << 0, 1, 2).finished());
  const Triangles fan = Triangulate(OnePolygon({{-1, 0}, {1, 0}, {1, 1}, {0, 2}, {-1, 1}}));
  EXPECT_EQ(fan, (Triangles(3, 3) << 3, 4, 0, 3, 0, 1, 3, 1, 2).finished());
}

/// A grid of quads about x = 0 whose -x half is bent a little, so that the two sides would cut differently by
/// themselves.
PolygonMesh BentGrid() {
  PolygonMesh mesh;
  constexpr int kSide = 7;
  mesh.vertices.resize(kSide * kSide, 3);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = i - kSide / 2, bend = x < 0 ? 0.02 * ((i + 2 * j) % 3 - 1) : 0.0;
      mesh.vertices.row(j * kSide + i) << x, j + bend + 0.01 * std::abs(x) * j, 0;
    }
  }
  for (int j = 0; j + 1 < kSide; ++j) {
    for (int i = 0; i + 1 < kSide; ++i) {
      const int v = j * kSide + i;
      mesh.corners.insert(mesh.corners.end(), {v, v + 1, v + kSide + 1, v + kSide});
      mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
    }
  }
  return mesh;
}

TEST(Triangulate, IsExactlySymmetricWithAMirrorMap) {
  const PolygonMesh mesh = BentGrid();
  const std::vector<int> mirror = FindMirror(mesh.vertices, 0.1);
  std::set<std::set<int>> triangles;
  const Triangles cut = Triangulate(mesh, mirror);
  for (const auto& t : cut.rowwise()) triangles.insert({t[0], t[1], t[2]});
  for (const auto& t : cut.rowwise()) EXPECT_TRUE(triangles.contains({mirror[t[0]], mirror[t[1]], mirror[t[2]]}));
  EXPECT_NE(Triangulate(mesh), cut) << "the bend should matter, or this test shows nothing";
}

TEST(Triangulate, RefusesAPolygonWithoutMirrorImage) {
  PolygonMesh mesh = BentGrid();
  const std::vector<int> mirror = FindMirror(mesh.vertices, 0.1);
  mesh.corners.resize(mesh.corners.size() - 4);
  mesh.offsets.pop_back();
  ExpectError([&] { Triangulate(mesh, mirror); }, "has no mirror image");
  ExpectError([&] { Triangulate(mesh, {0, 1}); }, "2 entries");
}

TEST(TriangulateMesh, KeepsTheUvOfEachCorner) {
  // Two quads of a grid that share vertices 1 and 4; the second is apart in the picture.
  PolygonMesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1.5, 1, 0, 2, 1, 0;
  mesh.offsets = {0, 4, 8};
  mesh.corners = {0, 1, 4, 3, 1, 2, 5, 4};
  mesh.uv = TextureCoordinates::Random(8, 2);
  mesh.uv_corners = {0, 1, 2, 3, 4, 5, 6, 7};
  const TriangleMesh triangles = TriangulateMesh(mesh);
  EXPECT_EQ(triangles.triangles, Triangulate(mesh));
  EXPECT_EQ(triangles.uv, mesh.uv);
  ASSERT_EQ(triangles.uv_triangles.rows(), 4);
  for (int t = 0; t < 4; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int row = triangles.uv_triangles(t, k);
      EXPECT_EQ(mesh.corners[row], triangles.triangles(t, k));
      EXPECT_EQ(row / 4, t / 2) << "a corner keeps the UV of its own polygon";
    }
  }
  mesh.uv_corners.pop_back();
  ExpectError([&] { TriangulateMesh(mesh); }, "UV of 7 corners, expected 8");
}

TEST(TriangulateMesh, WithoutUvIsTriangulate) {
  const PolygonMesh mesh = BentGrid();
  const std::vector<int> mirror = FindMirror(mesh.vertices, 0.1);
  const TriangleMesh triangles = TriangulateMesh(mesh, mirror);
  EXPECT_EQ(triangles.triangles, Triangulate(mesh, mirror));
  EXPECT_FALSE(triangles.has_uv());
}

TEST(FindMirror, IsAnInvolutionOrAnError) {
  Points points(3, 3);
  points << 1, 0, 0, -1.001, 0, 0, 0, 2, 0;
  EXPECT_EQ(FindMirror(points, 0.01), (std::vector<int>{1, 0, 2}));
  ExpectError([&] { FindMirror(points, 1e-4); }, "the mirror image of vertex 0");
  Points crowded(3, 3);
  crowded << 1, 0, 0, 1.001, 0, 0, -1, 0, 0;
  ExpectError([&] { FindMirror(crowded, 0.01); }, "share the mirror image 2");
}

}  // namespace
}  // namespace daumier::geometry
