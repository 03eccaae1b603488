#include "geometry/nearest.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(VertexTree, FindsWhatLookingAtAllVerticesFinds) {
  const Points points = testing::Torus(3, 1, 21, 13).vertices;
  const VertexTree tree(points);
  Rng rng(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3 p(rng.Uniform(-5, 5), rng.Uniform(-5, 5), rng.Uniform(-2, 2));
    int expected;
    const double distance = (points.rowwise() - p.transpose()).rowwise().norm().minCoeff(&expected);
    EXPECT_EQ(tree.Nearest(p).vertex, expected);
    EXPECT_NEAR(tree.Nearest(p).distance, distance, 1e-12);
  }
  testing::ExpectError([] { VertexTree(Points(0, 3)); }, "at least one point");
}

TEST(ClosestPointOnMesh, OnFaceEdgeAndCorner) {
  TriangleMesh mesh = testing::FlatSheet(1);
  mesh.triangles.conservativeResize(1, 3);  // (0,0), (1,0), (1,1)
  const SurfacePoint inside = ClosestPointOnMesh(mesh, {0.75, 0.25, 2});
  EXPECT_LT((inside.position - Vector3(0.75, 0.25, 0)).norm(), 1e-14);
  EXPECT_LT((inside.barycentric - Vector3(0.25, 0.5, 0.25)).norm(), 1e-14);
  EXPECT_NEAR(inside.distance, 2, 1e-14);
  EXPECT_LT((ClosestPointOnMesh(mesh, {0, 1, 0}).position - Vector3(0.5, 0.5, 0)).norm(), 1e-14);
  EXPECT_LT((ClosestPointOnMesh(mesh, {3, -1, 0}).position - Vector3(1, 0, 0)).norm(), 1e-14);
  testing::ExpectError([] { ClosestPointOnMesh({}, Vector3::Zero()); }, "without triangles");
}

}  // namespace
}  // namespace daumier::geometry
