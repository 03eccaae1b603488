#include "faces/face_holes.h"

#include "geometry/topology.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(FaceHoles, AreFoundAtTheirLandmarks) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceHoles holes = FindHoles(face);
  ASSERT_EQ(holes.others.size(), 1u);
  EXPECT_EQ(holes.others[0].size(), 2u * testing::SyntheticGrid::kHalf);
  EXPECT_GT(holes.mouth.size(), holes.eye_left.size());
  for (const int v : holes.eye_left) EXPECT_GT(face.neutral(v, 0), 0);
  for (const int v : holes.eye_right) EXPECT_LT(face.neutral(v, 0), 0);
}

TEST(FaceHoles, AHoleElsewhereIsNoPartOfTheFace) {
  FaceTemplate face = testing::SyntheticFace();
  // Takes one vertex of the forehead out of the surface.
  std::vector<Eigen::RowVector3i> kept;
  const int taken = testing::SyntheticGrid().at(0, 18);
  for (const auto& triangle : face.triangles.rowwise()) {
    if ((triangle.array() != taken).all()) kept.push_back(triangle);
  }
  face.triangles.resize(kept.size(), 3);
  for (size_t t = 0; t < kept.size(); ++t) face.triangles.row(t) = kept[t];
  EXPECT_EQ(FindHoles(face).others.size(), 2u);
}

TEST(FaceHoles, AClosedFaceHasNone) {
  FaceTemplate face = testing::SyntheticFace();
  geometry::Triangles closed(face.triangles.rows() + face.closing_triangles.rows(), 3);
  closed << face.triangles, face.closing_triangles;
  face.triangles = closed;
  const FaceHoles holes = FindHoles(face);
  EXPECT_TRUE(holes.mouth.empty() && holes.eye_left.empty() && holes.eye_right.empty());
  CloseHoles(holes, face);
  EXPECT_EQ(face.closing_triangles.rows(), 0);
  EXPECT_EQ(face.num_eye_closing_triangles, 0);
}

TEST(FaceHoles, ClosingLeavesTheOthersOpen) {
  FaceTemplate face = testing::SyntheticFace();
  CloseHoles(FindHoles(face), face);
  geometry::Triangles closed(face.triangles.rows() + face.closing_triangles.rows(), 3);
  closed << face.triangles, face.closing_triangles;
  EXPECT_NO_THROW(geometry::CheckManifold(closed, face.num_vertices()));
  EXPECT_EQ(geometry::BoundaryLoops(closed, face.num_vertices()).size(), 1u);
}

}  // namespace
}  // namespace daumier::faces
