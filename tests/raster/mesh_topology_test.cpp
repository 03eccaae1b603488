#include "raster/mesh_topology.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

using testing::ExpectError;

TEST(MakeTopology, OfTwoTrianglesHasFiveEdgesOneOfThemShared) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 2, 1, 3}, 4);
  ASSERT_EQ(topology.edges.size(), 5u);
  ASSERT_EQ(topology.num_triangles(), 2);
  int num_shared = 0;
  for (const MeshEdge& edge : topology.edges) {
    if (edge.triangle[1] < 0) {
      EXPECT_EQ(edge.corner[1], -1);
      continue;
    }
    ++num_shared;
    EXPECT_EQ(edge.first, 1);
    EXPECT_EQ(edge.second, 2);
    EXPECT_EQ(edge.triangle, (std::array<int, 2>{0, 1}));
    EXPECT_EQ(edge.corner, (std::array<int, 2>{0, 3}));
  }
  EXPECT_EQ(num_shared, 1);
}

TEST(MakeTopology, EdgesAreAscending) {
  const MeshTopology topology = MakeTopology(std::vector<int>{4, 0, 3, 3, 0, 1, 2, 3, 1}, 5);
  for (size_t i = 1; i < topology.edges.size(); ++i) {
    EXPECT_LT(std::pair(topology.edges[i - 1].first, topology.edges[i - 1].second),
              std::pair(topology.edges[i].first, topology.edges[i].second));
  }
}

TEST(MakeTopology, AnEdgeOfThreeTrianglesAppearsTwice) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 1, 0, 3, 0, 1, 4}, 5);
  std::vector<std::array<int, 2>> pairs;
  for (const MeshEdge& edge : topology.edges) {
    if (edge.first == 0 && edge.second == 1) pairs.push_back(edge.triangle);
  }
  EXPECT_EQ(pairs, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(topology.edges.size(), 8u);
}

TEST(MakeTopology, ATriangleWithARepeatedVertexIsKeptAndHasNoEdges) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 1, 1, 2}, 3);
  EXPECT_EQ(topology.num_triangles(), 2);
  EXPECT_EQ(topology.edges.size(), 3u);
}

TEST(MakeTopology, RefusesVerticesOutOfRangeAndIncompleteTriangles) {
  ExpectError([] { MakeTopology(std::vector<int>{0, 1, 3}, 3); }, "triangle 0 has vertex 3");
  ExpectError([] { MakeTopology(std::vector<int>{0, -1, 2}, 3); }, "triangle 0 has vertex -1");
  ExpectError([] { MakeTopology(std::vector<int>{0, 1, 2, 0}, 3); }, "multiple of 3");
}

}  // namespace
}  // namespace daumier::raster
