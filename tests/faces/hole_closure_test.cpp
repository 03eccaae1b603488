#include "faces/hole_closure.h"

#include "geometry/topology.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(HoleClosure, ClosesAnOpenSurface) {
  // A tetrahedron without its base; the loop has the surface on its left.
  geometry::Triangles open(3, 3);
  open << 0, 1, 3, 1, 2, 3, 2, 0, 3;
  const auto loops = geometry::BoundaryLoops(open, 4);
  ASSERT_EQ(loops.size(), 1u);
  for (const int num_rings : {0, 1, 3}) {
    const HoleClosure closure{loops[0], 4, num_rings};
    const auto added = closure.Triangles();
    ASSERT_EQ(int(added.size()), (2 * num_rings + 1) * 3);
    geometry::Triangles closed(open.rows() + Eigen::Index(added.size()), 3);
    closed.topRows(3) = open;
    for (size_t t = 0; t < added.size(); ++t) closed.row(3 + Eigen::Index(t)) = added[t].transpose();
    const int num_vertices = 4 + closure.num_vertices();
    EXPECT_NO_THROW(geometry::CheckManifold(closed, num_vertices));
    EXPECT_TRUE(geometry::BoundaryLoops(closed, num_vertices).empty());
    EXPECT_EQ(geometry::EulerCharacteristic(closed), 2);
  }
}

TEST(HoleClosure, KnowsWhereItsVerticesHang) {
  const HoleClosure closure{{7, 3, 5}, 10, 2};
  EXPECT_EQ(closure.num_vertices(), 7);
  EXPECT_EQ(closure.apex(), 16);
  EXPECT_EQ(closure.vertex(-1, 1), 3);
  EXPECT_EQ(closure.vertex(1, 2), 15);
  EXPECT_EQ(closure.LoopVertexOf(15), 5);
  EXPECT_EQ(closure.LoopVertexOf(16), 7);
}

TEST(LoopPoints, AreTheRowsOfALoop) {
  const geometry::Points points = geometry::Points::Random(4, 3);
  EXPECT_EQ(LoopPoints(points, {3, 1}).row(1), points.row(1));
}

}  // namespace
}  // namespace daumier::faces
