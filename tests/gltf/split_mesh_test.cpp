#include "gltf/split_mesh.h"

#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::gltf {
namespace {

using faces::HeadMaterial;

/// Two triangles with a common edge, along which their UV differ at one end; vertex 4 is not used.
geometry::TriangleMesh Hinge() {
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 9, 9, 9;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 2, 1, 3;
  mesh.uv.resize(6, 2);
  mesh.uv << 0, 0, 1, 0, 0, 1, 0.5, 0.5, 1, 1, 0, 1;  // Row 5 repeats row 2.
  mesh.uv_triangles.resize(2, 3);
  mesh.uv_triangles << 0, 1, 2, 5, 3, 4;
  return mesh;
}

TEST(SplitAtSeams, SplitsWhereUvDiffersAndNowhereElse) {
  const SplitMesh split = SplitAtSeams(Hinge(), {});
  EXPECT_EQ(split.source_vertices, (std::vector<int>{0, 1, 1, 2, 3}));
  EXPECT_EQ(split.uv.row(1), Eigen::RowVector2d(0.5, 0.5));
  EXPECT_EQ(split.uv.row(2), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(split.indices, (std::vector<uint32_t>{0, 2, 3, 3, 1, 4}));
  EXPECT_TRUE(split.materials.empty());
}

TEST(SplitAtSeams, SplitsWhereMaterialsDifferIfTheyAreGiven) {
  geometry::TriangleMesh mesh = Hinge();
  mesh.uv.resize(0, 2);
  mesh.uv_triangles.resize(0, 3);
  EXPECT_EQ(SplitAtSeams(mesh, {}).num_vertices(), 4);
  const SplitMesh split = SplitAtSeams(mesh, {HeadMaterial::kSkin, HeadMaterial::kMouth});
  EXPECT_EQ(split.source_vertices, (std::vector<int>{0, 1, 1, 2, 2, 3}));
  EXPECT_EQ(split.materials[size_t(split.indices[0])], HeadMaterial::kSkin);
  EXPECT_EQ(split.materials[size_t(split.indices[5])], HeadMaterial::kMouth);
  EXPECT_EQ(split.uv.rows(), 0);
}

TEST(SplitAtSeams, OfABallDoublesItsSeam) {
  const geometry::TriangleMesh ball = testing::UvBall(1, 12, 18);
  EXPECT_EQ(SplitAtSeams(ball, {}).num_vertices(), ball.vertices.rows() + 11) << "one a ring";
}

TEST(SplitAtSeams, RefusesCornersAndMaterialsThatDoNotFit) {
  geometry::TriangleMesh mesh = Hinge();
  testing::ExpectError([&] { SplitAtSeams(mesh, {HeadMaterial::kSkin}); }, "1 materials for 2 triangles");
  mesh.triangles(1, 1) = 5;
  testing::ExpectError([&] { SplitAtSeams(mesh, {}); }, "triangle 1 names vertex 5, there are 5");
}

TEST(OrderForCompression, ShowsTheSameTriangles) {
  const geometry::TriangleMesh ball = testing::UvBall(1, 12, 18);
  const SplitMesh split =
      SplitAtSeams(ball, std::vector<HeadMaterial>(size_t(ball.triangles.rows()), HeadMaterial::kSkin));
  const SplitMesh ordered = OrderForCompression(split);
  ASSERT_EQ(ordered.num_vertices(), split.num_vertices());
  EXPECT_EQ(ordered.materials.size(), split.materials.size());
  using Corner = std::tuple<int, double, double>;
  const auto triangles = [](const SplitMesh& mesh) {
    std::multiset<std::array<Corner, 3>> found;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      std::array<Corner, 3> triangle;
      for (size_t c = 0; c < 3; ++c) {
        const uint32_t n = mesh.indices[i + c];
        triangle[c] = {mesh.source_vertices[n], mesh.uv(n, 0), mesh.uv(n, 1)};
      }
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      found.insert(triangle);
    }
    return found;
  };
  EXPECT_EQ(triangles(ordered), triangles(split));
}

}  // namespace
}  // namespace daumier::gltf
