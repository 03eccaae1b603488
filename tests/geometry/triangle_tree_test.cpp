#include "geometry/triangle_tree.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::geometry {
namespace {

TEST(TriangleTree, ClosestPointIsThatOfLookingAtEveryTriangle) {
  for (const TriangleMesh& mesh : {testing::Torus(3, 1, 21, 13), testing::FlatSheet(9), testing::FlatSheet(1)}) {
    const TriangleTree tree(mesh);
    Rng rng(5);
    for (int trial = 0; trial < 200; ++trial) {
      const Vector3 p(rng.Uniform(-5, 5), rng.Uniform(-5, 5), rng.Uniform(-2, 2));
      const SurfacePoint expected = ClosestPointOnMesh(mesh, p), found = tree.Closest(p);
      EXPECT_EQ(found.triangle, expected.triangle);
      EXPECT_EQ(found.position, expected.position);
      EXPECT_EQ(found.barycentric, expected.barycentric);
      EXPECT_EQ(found.distance, expected.distance);
    }
    for (int v = 0; v < mesh.vertices.rows(); ++v)
      EXPECT_EQ(tree.Closest(mesh.vertices.row(v)).triangle, ClosestPointOnMesh(mesh, mesh.vertices.row(v)).triangle);
  }
}

TEST(TriangleTree, OverlappingBoxesAreThoseOfLookingAtEveryTriangle) {
  const TriangleMesh mesh = testing::Torus(3, 1, 15, 9);
  const TriangleTree tree(mesh);
  Rng rng(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3 low(rng.Uniform(-4, 4), rng.Uniform(-4, 4), rng.Uniform(-1, 1));
    const Eigen::AlignedBox3d box(low, low + Vector3::Constant(rng.Uniform(0.1, 2)));
    std::vector<int> expected;
    for (int f = 0; f < mesh.triangles.rows(); ++f) {
      if (TriangleBox(mesh, f).intersects(box)) expected.push_back(f);
    }
    EXPECT_EQ(tree.Overlapping(box), expected);
  }
}

TEST(TriangleTree, AnswersQueriesFromSeveralThreads) {
  const TriangleTree tree(testing::Torus(3, 1, 21, 13));
  testing::ExpectTheSameFromThreads(20, [&] {
    std::vector<double> distances;
    for (double x = -5; x <= 5; x += 0.5) distances.push_back(tree.Closest({x, 1, 0.3}).distance);
    return distances;
  });
}

TEST(TriangleTree, RefusesWhatIsNoSurface) {
  testing::ExpectError([] { TriangleTree({}); }, "at least one triangle");
  TriangleMesh mesh = testing::EquilateralTriangle();
  mesh.vertices(1, 0) = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { TriangleTree{mesh}; }, "finite");
  mesh = testing::EquilateralTriangle();
  mesh.triangles(0, 2) = 3;
  testing::ExpectError([&] { TriangleTree{mesh}; }, "vertex that is not there");
}

}  // namespace
}  // namespace daumier::geometry
