#include "geometry/debris.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

/// Both meshes in one, the second moved along x.
TriangleMesh SideBySide(const TriangleMesh& a, const TriangleMesh& b, double x) {
  TriangleMesh both{Points(a.vertices.rows() + b.vertices.rows(), 3),
                    Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  both.vertices << a.vertices, b.vertices.rowwise() + Eigen::RowVector3d(x, 0, 0);
  both.triangles << a.triangles, b.triangles.array() + int(a.vertices.rows());
  return both;
}

TEST(RemoveDebris, RemovesSmallPiecesFarAway) {
  const TriangleMesh ball = testing::Sphere(1, 3), crumb = testing::Sphere(0.02, 1);
  const TriangleMesh scan = SideBySide(SideBySide(crumb, ball, 50), crumb, 1e6);
  const CleanSurface clean = RemoveDebris(scan);
  EXPECT_EQ(clean.num_pieces_removed, 2);
  EXPECT_EQ(clean.mesh.triangles, ball.triangles);
  EXPECT_EQ(clean.mesh.vertices, scan.vertices.middleRows(crumb.vertices.rows(), ball.vertices.rows()));
}

TEST(RemoveDebris, KeepsSmallPiecesNearbyAndLargeOnesAnywhere) {
  const TriangleMesh ball = testing::Sphere(1, 3), crumb = testing::Sphere(0.02, 1);
  for (const double x : {0.0, 1.0, 1.25})
    EXPECT_EQ(RemoveDebris(SideBySide(ball, crumb, x)).num_pieces_removed, 0) << x;
  EXPECT_EQ(RemoveDebris(SideBySide(ball, crumb, 1.4)).num_pieces_removed, 1);
  EXPECT_EQ(RemoveDebris(SideBySide(ball, testing::Sphere(0.2, 2), 100)).num_pieces_removed, 0);
  // A chain: each piece comes within reach by the one before.
  TriangleMesh chain = ball;
  for (int i = 1; i <= 10; ++i) chain = SideBySide(chain, crumb, 1 + 0.25 * i);
  EXPECT_EQ(RemoveDebris(chain).num_pieces_removed, 0);
}

TEST(RemoveDebris, KeepsASurfaceOfSinglePieces) {
  const TriangleMesh ball = testing::Sphere(1, 3);
  TriangleMesh soup{Points(ball.triangles.size(), 3), Triangles(ball.triangles.rows(), 3)};
  for (Eigen::Index i = 0; i < ball.triangles.size(); ++i) {
    soup.vertices.row(i) = ball.vertices.row(ball.triangles.data()[i]);
    soup.triangles.data()[i] = int(i);
  }
  EXPECT_EQ(RemoveDebris(soup).mesh.triangles, soup.triangles);
  testing::ExpectError([] { RemoveDebris({Points(3, 3), Triangles(0, 3)}); }, "at least one triangle");
}

}  // namespace
}  // namespace daumier::geometry
