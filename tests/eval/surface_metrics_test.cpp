#include "eval/surface_metrics.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::eval {
namespace {

/// Two triangles in the plane z = 0 that share the edge from (0, 0) to (0, 2), of areas 1 and 3.
geometry::TriangleMesh TwoTriangles() {
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 0, 2, 0, -1, 1, 0, 3, 1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 3, 1;
  return mesh;
}

TEST(CompareSurfaces, WeighsAnglesByTheTrueArea) {
  const geometry::TriangleMesh truth = TwoTriangles();
  geometry::Points folded = truth.vertices;
  const double angle = 50 * std::numbers::pi / 180;
  folded.row(3) << 3 * std::cos(angle), 1, 3 * std::sin(angle);  // The large triangle turns by 50 degrees.
  const SurfaceMetrics metrics = CompareSurfaces(truth, folded);
  EXPECT_NEAR(metrics.normal_error_degrees, 0.75 * 50, 1e-9);
  EXPECT_EQ(metrics.flipped_triangles, 0);
}

TEST(CompareSurfaces, IsZeroForMovedAndScaledSurfaces) {
  const geometry::TriangleMesh truth = TwoTriangles();
  const geometry::Points moved = (2.5 * truth.vertices).rowwise() + Eigen::RowVector3d(1, -2, 3);
  EXPECT_EQ(CompareSurfaces(truth, moved).normal_error_degrees, 0);
  EXPECT_EQ(CompareSurfaces(truth, moved).flipped_triangles, 0);
}

TEST(CompareSurfaces, CountsFlippedAndCollapsedTriangles) {
  const geometry::TriangleMesh truth = TwoTriangles();
  geometry::Points flipped = truth.vertices, collapsed = truth.vertices;
  flipped.row(2) << 1, 1, 0;    // The small triangle lies upside down.
  collapsed.row(2) << 0, 1, 0;  // It lies in the edge.
  EXPECT_NEAR(CompareSurfaces(truth, flipped).normal_error_degrees, 0.25 * 180, 1e-9);
  EXPECT_EQ(CompareSurfaces(truth, flipped).flipped_triangles, 1);
  EXPECT_NEAR(CompareSurfaces(truth, collapsed).normal_error_degrees, 0.25 * 90, 1e-9);
  EXPECT_EQ(CompareSurfaces(truth, collapsed).flipped_triangles, 1);
}

TEST(CompareSurfaces, RefusesSurfacesThatCannotBeCompared) {
  const geometry::TriangleMesh truth = TwoTriangles();
  testing::ExpectError([&] { CompareSurfaces(truth, truth.vertices.topRows(3)); }, "3 vertices and the truth 4");
  testing::ExpectError(
      [&] {
        CompareSurfaces({geometry::Points::Zero(4, 3), truth.triangles}, truth.vertices);
      },
      "no area");
}

}  // namespace
}  // namespace daumier::eval
