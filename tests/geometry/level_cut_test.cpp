#include "geometry/level_cut.h"

#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

/// The unit square of two triangles, with x and y as UV.
TriangleMesh SquareToCut() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.uv = mesh.vertices.leftCols(2);
  mesh.uv_triangles = mesh.triangles;
  return mesh;
}

TEST(LevelCut, SplitsCrossedTrianglesWhereTheFunctionIsZero) {
  const TriangleMesh mesh = SquareToCut();
  const LevelCut cut = CutPositive(mesh, mesh.vertices.col(1).array() - 0.25);  // Keeps y <= 1/4.
  const Points points = WithEdgePoints(mesh.vertices, cut.points);
  ASSERT_EQ(cut.points.size(), 3u) << "the sides and the diagonal";
  EXPECT_EQ(points.topRows(4), mesh.vertices) << "vertices keep their numbers";
  for (int i = 4; i < 7; ++i) EXPECT_NEAR(points(i, 1), 0.25, 1e-15);
  EXPECT_EQ(cut.triangles.rows(), 3) << "a quadrilateral and a corner";
  const TriangleMesh kept{points, cut.triangles};
  EXPECT_NEAR(TriangleAreas(kept).sum(), 0.25, 1e-15);
  EXPECT_TRUE((AreaNormals(kept).col(2).array() > 0).all()) << "oriented as before";
  EXPECT_NO_THROW(CheckManifold(cut.triangles, 7));
  for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((cut.uv.row(cut.uv_triangles(t, k)) - points.row(cut.triangles(t, k)).leftCols(2)).norm(), 1e-15);
}

TEST(LevelCut, KeepsWhatIsNotPositiveAndDropsTheRest) {
  const TriangleMesh mesh = SquareToCut();
  EXPECT_EQ(CutPositive(mesh, Eigen::Vector4d::Zero()).triangles, mesh.triangles);
  EXPECT_EQ(CutPositive(mesh, Eigen::Vector4d::Ones()).triangles.rows(), 0);
}

TEST(LevelCut, KeepsAwayFromTheEndsOfEdges) {
  const LevelCut cut = CutPositive(SquareToCut(), Eigen::Vector4d(0, -1e9, 1, 1));
  for (const EdgePoint& point : cut.points) {
    EXPECT_GE(point.share, kLeastEdgeShare);
    EXPECT_LE(point.share, 1 - kLeastEdgeShare);
  }
}

TEST(LevelCut, RefusesAnotherNumberOfValues) {
  testing::ExpectError([] { CutPositive(SquareToCut(), Eigen::Vector3d::Zero()); },
                       "3 values were given for 4 vertices");
}

}  // namespace
}  // namespace daumier::geometry
