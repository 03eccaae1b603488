#include "raster/vertex_normals.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

TEST(VertexNormals, AverageUnitNormalsOfTriangles) {
  // Triangles of different size in the planes z = 0 and x = 0 that share the edge 0-1; vertex 4 is alone.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 2, 1, 0, 1, 3}, 5);
  const std::vector<double> vertices = {0, 0, 0, 0, 1, 0, 5, 0, 0, 0, 0, 1, 7, 7, 7};
  NormalMemory<double> memory;
  std::vector<double> normals(15);
  VertexNormals(topology, vertices.data(), memory, normals.data());
  const double half = std::sqrt(0.5);
  const std::vector<double> expected = {half, 0, half, half, 0, half, 0, 0, 1, 1, 0, 0, 0, 0, 0};
  for (int i = 0; i < 15; ++i) EXPECT_NEAR(normals[i], expected[i], 1e-12) << i;
}

TEST(VertexNormals, GradientEqualsCentralDifferences) {
  const Camera unused = {};
  const MeshTopology topology = BumpyBall<double>(4, 1, unused).topology;
  const int num_vertices = topology.num_vertices;
  auto vertices = RandomNumbers<double>(3 * num_vertices, 1);
  const auto weights = RandomNumbers<double>(3 * num_vertices, 2);
  NormalMemory<double> memory;
  std::vector<double> normals(3 * num_vertices), gradient(3 * num_vertices);
  const auto sum = [&](const std::vector<double>& x) {
    NormalMemory<double> other;
    VertexNormals(topology, x.data(), other, normals.data());
    return Dot(weights, normals);
  };
  VertexNormals(topology, vertices.data(), memory, normals.data());
  VertexNormalsBackward(topology, memory, weights.data(), gradient.data());
  EXPECT_LT(MaxDifference(sum, vertices, gradient), 1e-6);
}

TEST(VertexNormals, TrianglesWithoutAreaHaveNoNormalAndNoGradient) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<float> vertices = {0, 0, 0, 1, 1, 1, 2, 2, 2}, weights(9, 1.0f);
  NormalMemory<float> memory;
  std::vector<float> normals(9, 5.0f), gradient(9);
  VertexNormals(topology, vertices.data(), memory, normals.data());
  VertexNormalsBackward(topology, memory, weights.data(), gradient.data());
  EXPECT_EQ(normals, std::vector<float>(9));
  EXPECT_EQ(gradient, std::vector<float>(9));
}

}  // namespace
}  // namespace daumier::raster
