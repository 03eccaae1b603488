#include "render/rasteriser.h"

#include "core/error.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

/// World x and y are pixels (y down in the picture, up in the world with the origin at the lower left), z towards the
/// viewer.
Camera PixelCamera(int height, int width) {
  Camera camera;
  camera.principal_point = {0.0, height};
  camera.height = height;
  camera.width = width;
  return camera;
}

geometry::TriangleMesh Mesh(const std::vector<std::array<double, 3>>& vertices,
                            const std::vector<std::array<int, 3>>& triangles) {
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(static_cast<int>(vertices.size()), 3);
  mesh.triangles.resize(static_cast<int>(triangles.size()), 3);
  for (size_t i = 0; i < vertices.size(); ++i) mesh.vertices.row(i) << vertices[i][0], vertices[i][1], vertices[i][2];
  for (size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.row(i) << triangles[i][0], triangles[i][1], triangles[i][2];
  return mesh;
}

std::vector<int> Row(const Raster& raster, int row) {
  return {raster.triangle.begin() + raster.index(row, 0),
          raster.triangle.begin() + raster.index(row, 0) + raster.width};
}

TEST(Rasterise, BarycentricsAndDepthAreThoseWorkedOutByHand) {
  // Corners in picture coordinates: (0, 8), (8, 8), (0, 0). At the centre (1.5, 6.5): b1 = 1.5 / 8, b2 = 1.5 / 8, b0 =
  // 5 / 8.
  const auto mesh = Mesh({{0, 0, 0}, {8, 0, 16}, {0, 8, -8}}, {{0, 1, 2}});
  const Raster raster = Rasterise(PixelCamera(8, 8), mesh);
  const size_t pixel = raster.index(6, 1);
  EXPECT_EQ(raster.triangle[pixel], 0);
  EXPECT_FLOAT_EQ(raster.barycentric[pixel][0], 0.625f);
  EXPECT_FLOAT_EQ(raster.barycentric[pixel][1], 0.1875f);
  EXPECT_FLOAT_EQ(raster.barycentric[pixel][2], 0.1875f);
  EXPECT_DOUBLE_EQ(raster.depth[pixel], -(0.1875 * 16 - 0.1875 * 8));
  EXPECT_EQ(raster.triangle[raster.index(1, 6)], -1);
  EXPECT_EQ(raster.depth[raster.index(1, 6)], std::numeric_limits<double>::infinity());
}

TEST(Rasterise, TopAndLeftEdgesCoverTheCentresOnThemOthersDoNot) {
  // A square whose four edges run through pixel centres: rows and columns 1 .. 4 of centres 1.5 .. 4.5, the last ones
  // left out.
  const auto square = Mesh({{1.5, 1.5, 0}, {4.5, 1.5, 0}, {4.5, 4.5, 0}, {1.5, 4.5, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Raster raster = Rasterise(PixelCamera(6, 6), square);
  const std::vector<int> nothing(6, -1);
  EXPECT_EQ(Row(raster, 0), nothing);
  EXPECT_NE(raster.triangle[raster.index(1, 1)], -1);
  EXPECT_NE(raster.triangle[raster.index(3, 3)], -1);
  EXPECT_EQ(raster.triangle[raster.index(4, 2)], -1) << "bottom edge";
  EXPECT_EQ(raster.triangle[raster.index(2, 4)], -1) << "right edge";
  EXPECT_EQ(std::count(raster.triangle.begin(), raster.triangle.end(), -1), 36 - 9);
}

/// A square of n x n cells with its inner vertices shaken, each cell cut in two; the outline is exact.
geometry::TriangleMesh ShakenGrid(int cells, double size, double shake, uint64_t seed) {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int, 3>> triangles;
  Rng rng(seed);
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const bool inside = i > 0 && j > 0 && i < cells && j < cells;
      const double amount = inside ? shake * size / cells : 0.0;
      vertices.push_back({size * j / cells + amount * (2 * rng.Uniform() - 1),
                          size * i / cells + amount * (2 * rng.Uniform() - 1), 0.0});
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const int v = i * (cells + 1) + j, up = v + cells + 1;
      triangles.push_back({v, v + 1, up + 1});
      triangles.push_back({v, up + 1, up});
    }
  }
  return Mesh(vertices, triangles);
}

TEST(Rasterise, ATessellatedSquareCoversEveryPixelExactlyOnce) {
  // Vertices on centres (7 cells in 56.. pixels), on corners, and shaken off both.
  for (const double shake : {0.0, 0.3}) {
    for (const int cells : {7, 28, 45}) {
      const auto mesh = ShakenGrid(cells, 56.0, shake, cells);
      const int size = 56;
      std::vector<int> covered(size * size, 0);
      geometry::TriangleMesh single{mesh.vertices, geometry::Triangles(1, 3)};
      for (int t = 0; t < mesh.triangles.rows(); ++t) {
        single.triangles.row(0) = mesh.triangles.row(t);
        const Raster raster = Rasterise(PixelCamera(size, size), single);
        for (size_t i = 0; i < covered.size(); ++i) covered[i] += raster.triangle[i] == 0;
      }
      EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), size * size) << cells << " " << shake;
    }
  }
}

TEST(Rasterise, BarycentricsRebuildThePixelCentre) {
  const auto mesh = ShakenGrid(9, 40.0, 0.3, 3);
  const Raster raster = Rasterise(PixelCamera(40, 40), mesh);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column) {
      const size_t pixel = raster.index(row, column);
      ASSERT_GE(raster.triangle[pixel], 0);
      Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
      float sum = 0;
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(raster.barycentric[pixel][k], 0.0f);
        sum += raster.barycentric[pixel][k];
        point += double{raster.barycentric[pixel][k]} * mesh.vertices.row(mesh.triangles(raster.triangle[pixel], k));
      }
      ASSERT_NEAR(sum, 1.0f, 1e-6f);
      ASSERT_NEAR(point.x(), column + 0.5, 1e-3);
      ASSERT_NEAR(40.0 - point.y(), row + 0.5, 1e-3);
    }
  }
}

TEST(Rasterise, TheNearerTriangleWinsInEitherOrder) {
  const std::vector<std::array<double, 3>> vertices = {{0, 0, 1}, {8, 0, 1}, {0, 8, 1},
                                                       {0, 0, 5}, {4, 0, 5}, {0, 4, 5}};
  const Raster near_last = Rasterise(PixelCamera(8, 8), Mesh(vertices, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(near_last.triangle[near_last.index(6, 1)], 1);
  EXPECT_EQ(near_last.triangle[near_last.index(6, 5)], 0);
  const Raster near_first = Rasterise(PixelCamera(8, 8), Mesh(vertices, {{3, 4, 5}, {0, 1, 2}}));
  EXPECT_EQ(near_first.triangle[near_first.index(6, 1)], 0);
  EXPECT_EQ(near_first.depth, near_last.depth);
}

TEST(Rasterise, AtEqualDepthTheLowerRowWins) {
  const Raster raster = Rasterise(PixelCamera(8, 8), Mesh({{0, 0, 1}, {8, 0, 1}, {0, 8, 1}}, {{0, 1, 2}, {1, 2, 0}}));
  EXPECT_EQ(std::count(raster.triangle.begin(), raster.triangle.end(), 1), 0);
}

TEST(Rasterise, BackFacesAreSeenUnlessCulled) {
  const auto back = Mesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 2, 1}});
  const auto front = Mesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}});
  const Raster seen = Rasterise(PixelCamera(8, 8), back);
  EXPECT_EQ(seen.triangle, Rasterise(PixelCamera(8, 8), front, {.cull_back_faces = true}).triangle);
  EXPECT_FLOAT_EQ(seen.barycentric[seen.index(6, 1)][1], 0.1875f);
  const Raster culled = Rasterise(PixelCamera(8, 8), back, {.cull_back_faces = true});
  EXPECT_EQ(std::count(culled.triangle.begin(), culled.triangle.end(), -1), 64);
}

TEST(Rasterise, PerspectiveBarycentricsAreThoseOfThePointOnTheSurface) {
  // A floor that runs away from the viewer; each pixel's ray is met with the triangle's plane for comparison.
  const Camera camera = WithPerspective(FrontalCamera({0, 0, 0}, 10.0, 64), 20.0);
  const auto mesh = Mesh({{-8, -5, 5}, {8, -5, 5}, {0, 3, -30}}, {{0, 1, 2}});
  const Raster raster = Rasterise(camera, mesh);
  const Eigen::Vector3d eye(0, 0, 20);
  const Eigen::Vector3d p0 = mesh.vertices.row(0), p1 = mesh.vertices.row(1), p2 = mesh.vertices.row(2);
  int checked = 0;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      const size_t pixel = raster.index(row, column);
      if (raster.triangle[pixel] < 0) continue;
      const Eigen::Vector3d direction((column + 0.5 - 32) / camera.scale, -(row + 0.5 - 32) / camera.scale, -1.0);
      const Eigen::Vector3d normal = (p1 - p0).cross(p2 - p0);
      const double depth = normal.dot(p0 - eye) / normal.dot(direction);
      ASSERT_NEAR(raster.depth[pixel], depth, 0.02);
      const auto& b = raster.barycentric[pixel];
      const Eigen::Vector3d point = double{b[0]} * p0 + double{b[1]} * p1 + double{b[2]} * p2;
      ASSERT_LT((point - (eye + depth * direction)).norm(), 0.02);
      ++checked;
    }
  }
  EXPECT_GT(checked, 300);
}

TEST(Rasterise, LeavesOutWhatIsBehindAPerspectiveViewerOrEdgeOn) {
  const Camera camera = WithPerspective(FrontalCamera({0, 0, 0}, 10.0, 16), 20.0);
  const Raster behind = Rasterise(camera, Mesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 25}}, {{0, 1, 2}}));
  EXPECT_EQ(std::count(behind.triangle.begin(), behind.triangle.end(), -1), 256);
  const Raster edge_on = Rasterise(PixelCamera(8, 8), Mesh({{1, 1, 0}, {6, 6, 0}, {3, 3, 5}}, {{0, 1, 2}}));
  EXPECT_EQ(std::count(edge_on.triangle.begin(), edge_on.triangle.end(), -1), 64);
}

TEST(Rasterise, ClipsAtThePicturesBorder) {
  const Raster raster =
      Rasterise(PixelCamera(8, 8), Mesh({{-3000, -2000, 0}, {3000, -2000, 0}, {0, 5000, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(std::count(raster.triangle.begin(), raster.triangle.end(), 0), 64);
}

TEST(Rasterise, RefusesBadInput) {
  const auto mesh = Mesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}});
  EXPECT_THROW(Rasterise(PixelCamera(0, 8), mesh), Error);
  EXPECT_THROW(Rasterise(PixelCamera(8, 8), Mesh({{0, 0, 0}}, {{0, 0, 1}})), Error);
  auto not_finite = mesh;
  not_finite.vertices(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Rasterise(PixelCamera(8, 8), not_finite), Error);
  const Raster empty = Rasterise(PixelCamera(2, 2), {});
  EXPECT_EQ(empty.triangle, std::vector<int>(4, -1));
}

}  // namespace
}  // namespace daumier::render
