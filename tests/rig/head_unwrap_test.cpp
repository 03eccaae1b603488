#include "rig/head_unwrap.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace daumier::rig {
namespace {

double AreaOf(const geometry::TriangleMesh& flat, Eigen::Index triangle) {
  const Eigen::RowVector2d a = flat.uv.row(flat.uv_triangles(triangle, 0)),
                           b = flat.uv.row(flat.uv_triangles(triangle, 1)) - a,
                           c = flat.uv.row(flat.uv_triangles(triangle, 2)) - a;
  return 0.5 * (b.x() * c.y() - b.y() * c.x());
}

geometry::Points LandmarksOf(const faces::FaceTemplate& face) {
  const std::vector<int> landmarks(face.annotation.landmarks.begin() + 17, face.annotation.landmarks.end());
  return face.neutral(landmarks, Eigen::all);
}

TEST(UnwrapHead, FoldsNothingAndStaysInTheSquare) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const geometry::TriangleMesh head{face.neutral, face.triangles};
  const geometry::TriangleMesh flat = UnwrapHead(head, FaceDensity(head, LandmarksOf(face)));
  EXPECT_EQ(flat.triangles, face.triangles);
  EXPECT_GE(flat.uv.minCoeff(), 0);
  EXPECT_LE(flat.uv.maxCoeff(), 1);
  for (Eigen::Index t = 0; t < flat.triangles.rows(); ++t) EXPECT_GT(AreaOf(flat, t), 0) << t;
  // Two rows at each vertex of the seam but its end, one everywhere else.
  std::map<int, std::set<int>> rows;
  for (Eigen::Index i = 0; i < flat.triangles.size(); ++i)
    rows[flat.triangles.data()[i]].insert(flat.uv_triangles.data()[i]);
  int num_double = 0;
  for (const auto& [vertex, of_vertex] : rows) {
    ASSERT_LE(of_vertex.size(), 2u);
    if (of_vertex.size() < 2) continue;
    ++num_double;
    EXPECT_LT(face.neutral(vertex, 2), 0) << "the seam is behind";
  }
  EXPECT_GT(num_double, 10);
  EXPECT_LT(num_double, 40);
}

TEST(UnwrapHead, IsSymmetricAndShowsTheFaceLarge) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const geometry::TriangleMesh head{face.neutral, face.triangles};
  const auto eyes_apart = [&](const geometry::TriangleMesh& flat) {
    const auto& landmarks = face.annotation.landmarks;
    const Eigen::RowVector2d right = flat.uv.row(landmarks[36]), left = flat.uv.row(landmarks[45]);
    EXPECT_NEAR(right.x() + left.x(), 1, 0.02);
    EXPECT_NEAR(right.y(), left.y(), 0.02);
    return left.x() - right.x();
  };
  const double plain = eyes_apart(UnwrapHead(head, Eigen::VectorXd::Ones(head.triangles.rows()))),
               enlarged = eyes_apart(UnwrapHead(head, FaceDensity(head, LandmarksOf(face))));
  EXPECT_GT(plain, 0.1) << "the head's own left is on the right of the picture";
  EXPECT_GT(enlarged, 1.2 * plain);
}

TEST(UnwrapHead, RefusesASurfaceWithoutBorder) {
  geometry::TriangleMesh tetrahedron{geometry::Points(4, 3), geometry::Triangles(4, 3)};
  tetrahedron.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  testing::ExpectError([&] { UnwrapHead(tetrahedron, Eigen::VectorXd::Ones(4)); }, "without a border");
}

TEST(FaceDensity, FallsFromSixToOne) {
  geometry::TriangleMesh mesh{geometry::Points(6, 3), geometry::Triangles(2, 3)};
  mesh.vertices << 0, 0, 0, 0, 0, 0, 0, 0, 0, 90, 0, 0, 90, 0, 0, 90, 0, 0;
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  geometry::Points landmarks(2, 3);
  landmarks << -1, 0, 0, 1, 0, 0;
  const Eigen::VectorXd density = FaceDensity(mesh, landmarks);
  EXPECT_NEAR(density[0], 6, 1e-12);
  EXPECT_NEAR(density[1], 1, 1e-12);
}

}  // namespace
}  // namespace daumier::rig
