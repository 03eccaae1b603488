#include "geometry/topology.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

/// A 4 x 4 sheet without its middle four squares.
Triangles Frame() {
  const Triangles sheet = testing::FlatSheet(4).triangles;
  std::vector<int> kept;
  for (int f = 0; f < sheet.rows(); ++f) {
    if ((sheet.row(f).array() != 12).all()) kept.push_back(f);
  }
  return sheet(kept, Eigen::all);
}

TEST(Topology, AdjacencyOfASquareOfTwoTriangles) {
  const TriangleMesh mesh = testing::FlatSheet(1);
  const Adjacency neighbours = VertexNeighbours(mesh.triangles, 5);
  EXPECT_EQ(neighbours.size(), 5);
  EXPECT_EQ(neighbours.values, (std::vector<int>{1, 2, 3, 0, 3, 0, 3, 0, 1, 2}));
  EXPECT_EQ(neighbours[4].size(), 0u);
  const Adjacency fans = TrianglesAtVertices(mesh.triangles, 4);
  EXPECT_EQ(std::vector<int>(fans[0].begin(), fans[0].end()), (std::vector<int>{0, 1}));
  EXPECT_EQ(fans[1].size(), 1u);
  ExpectError([&] { VertexNeighbours(mesh.triangles, 3); }, "vertices 0 to 3, there are 3");
}

TEST(Topology, EulerCharacteristicCountsHandlesAndHoles) {
  EXPECT_EQ(EulerCharacteristic(testing::Sphere(1, 2).triangles), 2);
  EXPECT_EQ(EulerCharacteristic(testing::Torus(2, 1, 12, 8).triangles), 0);
  EXPECT_EQ(EulerCharacteristic(testing::FlatSheet(3).triangles), 1);
  EXPECT_EQ(EulerCharacteristic(Frame()), 0);
}

TEST(Topology, BoundaryLoopsKeepTheSurfaceOnTheirLeft) {
  EXPECT_TRUE(BoundaryLoops(testing::Sphere(1, 1).triangles, 18).empty());
  const auto square = BoundaryLoops(testing::FlatSheet(1).triangles, 4);
  EXPECT_EQ(square, (std::vector<std::vector<int>>{{0, 1, 3, 2}}));
  const auto frame = BoundaryLoops(Frame(), 25);
  ASSERT_EQ(frame.size(), 2u);
  EXPECT_EQ(frame[0].size(), 16u);
  EXPECT_EQ(frame[0][1], 1) << "outside counter-clockwise";
  EXPECT_EQ(frame[1].front(), 6);
  EXPECT_EQ(frame[1][1], 11) << "the hole clockwise";
}

TEST(Topology, RingsAroundTheMiddleOfASheet) {
  const TriangleMesh mesh = testing::FlatSheet(4);
  const Adjacency neighbours = VertexNeighbours(mesh.triangles, 26);
  EXPECT_EQ(VerticesWithin(neighbours, {12}, 0), (std::vector<int>{12}));
  EXPECT_EQ(VerticesWithin(neighbours, {12}, 1), (std::vector<int>{6, 7, 11, 12, 13, 17, 18}));
  EXPECT_EQ(VerticesWithin(neighbours, {12}, 9).size(), 25u);
  EXPECT_EQ(RingsFrom(neighbours, {12})[25], -1);
  EXPECT_EQ(RingsFrom(neighbours, {0, 24})[24], 0);
  ExpectError([&] { VerticesWithin(neighbours, {26}, 1); }, "vertex 26 is out of range");
}

TEST(Topology, ComponentsAreNumberedByTheirLowestVertex) {
  Triangles two(2, 3);
  two << 1, 3, 5, 0, 2, 4;
  EXPECT_EQ(ConnectedComponents(VertexNeighbours(two, 7)), (std::vector<int>{0, 1, 0, 1, 0, 1, 2}));
}

TEST(Topology, CheckManifoldNamesTheOffender) {
  CheckManifold(testing::Torus(2, 1, 5, 4).triangles, 20);
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 1, 3;
  ExpectError([&] { CheckManifold(triangles, 4); }, "run from vertex 0 to 1");
  triangles << 0, 1, 2, 0, 3, 4;
  ExpectError([&] { CheckManifold(triangles, 5); }, "meet at vertex 0");
  triangles << 0, 1, 2, 3, 3, 4;
  ExpectError([&] { CheckManifold(triangles, 5); }, "triangle 1 has vertex 3 twice");
  triangles << 0, 1, 2, 0, 2, 9;
  ExpectError([&] { CheckManifold(triangles, 5); }, "there are 5");
}

}  // namespace
}  // namespace daumier::geometry
