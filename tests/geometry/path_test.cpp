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

}  // namespace
}  // namespace daumier::geometry
