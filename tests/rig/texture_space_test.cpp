#include "rig/texture_space.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// The lower left half of [0, 1/2] x [0, 1/2] and the upper right one.
TextureSpace HalfSquares() {
  TextureSpace space;
  space.triangles.resize(2, 3);
  space.triangles << 0, 1, 2, 1, 3, 2;
  space.uv_triangles = space.triangles;
  space.uv.resize(4, 2);
  space.uv << 0, 0, 0.5, 0, 0, 0.5, 0.5, 0.5;
  space.charts = {TextureChart::kSkin, TextureChart::kSkin};
  return space;
}

TEST(TextureSpace, RasterisesByHand) {
  const TexelMap texels = HalfSquares().Rasterise(16);
  ASSERT_EQ(texels.num_texels(), 256);
  int counts[2] = {0, 0};
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      const int triangle = texels.triangles[size_t(texels.index(row, column))];
      const bool covered = row >= 8 && column < 8;  // Row 0 is the top of the picture.
      EXPECT_EQ(triangle >= 0, covered) << row << " " << column;
      if (covered) ++counts[triangle];
    }
  }
  EXPECT_EQ(counts[0], 36) << "the diagonal belongs to the first of its triangles";
  EXPECT_EQ(counts[1], 28);
  const size_t corner = size_t(texels.index(15, 0));  // Its middle is at 1/32, 1/32.
  EXPECT_TRUE(texels.weights[corner].isApprox(Eigen::Vector3f(0.875f, 0.0625f, 0.0625f), 1e-6f));
}

TEST(TextureSpace, WeightsGiveBackTheTexelsMiddle) {
  const TextureSpace space = HalfSquares();
  const TexelMap texels = space.Rasterise(33);
  for (int texel = 0; texel < texels.num_texels(); ++texel) {
    const int triangle = texels.triangles[size_t(texel)];
    if (triangle < 0) continue;
    Eigen::RowVector2d uv = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      uv += double(texels.weights[size_t(texel)][k]) * space.uv.row(space.uv_triangles(triangle, k));
    EXPECT_NEAR(uv.x(), (texel % 33 + 0.5) / 33, 1e-6);
    EXPECT_NEAR(uv.y(), 1 - (texel / 33 + 0.5) / 33, 1e-6);
  }
}

TEST(TextureSpace, CountsOverlaps) {
  TextureSpace space = HalfSquares();
  EXPECT_EQ(NumOverlappingTexels(space, 64), 0);
  space.uv.row(3) << 0.1, 0.1;  // The second triangle folds onto the first one.
  EXPECT_GT(NumOverlappingTexels(space, 64), 50);
}

TEST(TextureSpace, RefusesSizes) {
  const TextureSpace space = HalfSquares();
  testing::ExpectError([&] { space.Rasterise(8); }, "8 texels a side");
  testing::ExpectError([&] { NumOverlappingTexels(space, 10000); }, "10000 texels a side");
}

TEST(NearestShownTexels, AreTheNearestWithinReach) {
  const TexelMap texels = HalfSquares().Rasterise(32);
  const std::vector<int> nearest = NearestShownTexels(texels, 5);
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      const int r = std::max(row, 16), c = std::min(column, 15);  // Of the square.
      const bool reached = std::hypot(row - r, column - c) <= 5;
      EXPECT_EQ(nearest[size_t(texels.index(row, column))], reached ? texels.index(r, c) : -1) << row << " " << column;
    }
  }
  EXPECT_EQ(NearestShownTexels(texels, 0)[0], -1);
}

TEST(JoinedMesh, PutsEyesBehindTheHead) {
  RiggedHead head;
  head.mesh.vertices = geometry::Points::Random(4, 3);
  head.mesh.triangles = HalfSquares().triangles;
  head.mesh.uv = HalfSquares().uv;
  head.mesh.uv_triangles = head.mesh.triangles;
  for (const double x : {-3.0, 3.0}) head.eyes.push_back({head.mesh, {}, {x, 1, 2}});
  const geometry::TriangleMesh joined = JoinedMesh(head);
  ASSERT_EQ(joined.vertices.rows(), 12);
  EXPECT_EQ(joined.triangles.row(4), Eigen::RowVector3i(8, 9, 10));
  EXPECT_EQ(joined.uv_triangles.row(4), Eigen::RowVector3i(8, 9, 10));
  EXPECT_EQ(joined.uv.rows(), 12);
  EXPECT_TRUE(joined.vertices.row(9).isApprox(head.mesh.vertices.row(1) + Eigen::RowVector3d(3, 1, 2)));
}

}  // namespace
}  // namespace daumier::rig
