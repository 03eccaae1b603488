#include "geometry/path.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

class Paths : public ::testing::Test {
 protected:
  TriangleMesh sheet_ = testing::FlatSheet(3);  // Vertices 0..15, diagonals from lower left to upper right.
  Adjacency neighbours_ = VertexNeighbours(sheet_.triangles, 17);
};

TEST_F(Paths, FollowTheDiagonal) {
  EXPECT_EQ(ShortestPath(sheet_.vertices, neighbours_, 0, 15), (std::vector<int>{0, 5, 10, 15}));
  EXPECT_EQ(ShortestPath(sheet_.vertices, neighbours_, 3, 0), (std::vector<int>{3, 2, 1, 0}));
  EXPECT_EQ(ShortestPath(sheet_.vertices, neighbours_, 6, 6), (std::vector<int>{6}));
}

TEST_F(Paths, JoinWaypointsWithoutRepeats) {
  EXPECT_EQ(TracePath(sheet_.vertices, neighbours_, {0, 2, 10}, PathEnds::kOpen), (std::vector<int>{0, 1, 2, 6, 10}));
  EXPECT_EQ(TracePath(sheet_.vertices, neighbours_, {0, 2, 10}, PathEnds::kClosed),
            (std::vector<int>{0, 1, 2, 6, 10, 5}));
}

TEST_F(Paths, RefuseWhatCannotBeReached) {
  Points points(17, 3);
  points << sheet_.vertices, Eigen::RowVector3d::Ones();
  testing::ExpectError([&] { ShortestPath(points, neighbours_, 0, 16); }, "0 and 16 are not connected");
  testing::ExpectError([&] { ShortestPath(points, neighbours_, 0, 17); }, "from vertex 0 to 17");
  testing::ExpectError([&] { TracePath(points, neighbours_, {0}, PathEnds::kOpen); }, "two waypoints");
}

TEST_F(Paths, FindTheNearestSeedAlongEdges) {
  const NearestSeeds nearest = FindNearestSeeds(sheet_.vertices, neighbours_, {0, 3}, 100);
  EXPECT_EQ(nearest.seeds[1], 0);
  EXPECT_EQ(nearest.seeds[2], 1);
  EXPECT_EQ(nearest.seeds[3], 1);
  EXPECT_DOUBLE_EQ(nearest.distances[1], (sheet_.vertices.row(1) - sheet_.vertices.row(0)).norm());
  EXPECT_EQ(nearest.seeds[16], -1) << "a vertex without edges";
  const double step = nearest.distances[1];
  EXPECT_EQ(FindNearestSeeds(sheet_.vertices, neighbours_, {0}, 1.5 * step).seeds[2], -1) << "beyond reach";
}

TEST_F(Paths, LeadThroughOpenVerticesAlone) {
  std::vector<bool> is_open(17, true);
  for (const int v : {1, 5, 9, 13}) is_open[size_t(v)] = false;  // The second column.
  const NearestSeeds nearest = FindNearestSeeds(sheet_.vertices, neighbours_, {0}, 100, is_open);
  EXPECT_EQ(nearest.seeds[12], 0);
  EXPECT_EQ(nearest.seeds[2], -1);
  testing::ExpectError([&] { FindNearestSeeds(sheet_.vertices, neighbours_, {17}, 1); }, "seed 17");
  testing::ExpectError([&] { FindNearestSeeds(sheet_.vertices, neighbours_, {0}, 1, {true}); }, "expected 17");
}

}  // namespace
}  // namespace daumier::geometry
