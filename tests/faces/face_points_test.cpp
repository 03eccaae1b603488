#include "faces/face_points.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

Eigen::MatrixX2d SeenFromTheFront(const FaceTemplate& face) {
  Eigen::MatrixX2d seen = face.neutral.leftCols<2>();
  seen.col(1) *= -1;
  return seen;
}

/// The synthetic face with a jaw that runs from left to right.
FaceTemplate FaceWithJaw() {
  FaceTemplate face = testing::SyntheticFace();
  const auto& landmarks = face.annotation.landmarks;
  FeatureCurve jaw{.name = "jaw", .kind = "silhouette", .vertices = {}};
  for (size_t i = 12; i >= 4; --i) jaw.vertices.push_back(landmarks[i]);
  face.annotation.curves.push_back(jaw);
  return face;
}

TEST(FacePoints, AreMeansOfLandmarks) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto vertices = FindFacePoints(face);
  const Eigen::MatrixX2d seen = SeenFromTheFront(face);
  const auto& landmarks = face.annotation.landmarks;
  const Eigen::Vector2d top = ProjectedFacePoint(vertices, FacePoint::kEyeRightTop, seen, {0, 0});
  EXPECT_TRUE(top.isApprox((seen.row(landmarks[37]) + seen.row(landmarks[38])).transpose() / 2));
  EXPECT_LT(top.x(), 0) << "the face's own right is on the left of the picture";
  EXPECT_EQ(vertices.of_points[size_t(FacePoint::kMouthLeft)], std::vector<int>{landmarks[54]});
}

TEST(FacePoints, OfTheMirroredFaceAreTheMirroredPoints) {
  for (const FaceTemplate& face : {testing::SyntheticFace(), FaceWithJaw()}) {
    const auto vertices = FindFacePoints(face);
    const Eigen::MatrixX2d seen = SeenFromTheFront(face);
    for (int i = 0; i < kNumFacePoints; ++i) {
      const auto point = FacePoint(i);
      const double side = point == FacePoint::kContourRight ? -5 : 5;
      const Eigen::Vector2d here = ProjectedFacePoint(vertices, point, seen, {side, 2}),
                            there = ProjectedFacePoint(vertices, MirroredPoint(point), seen, {-side, 2});
      EXPECT_NEAR(here.x(), -there.x(), 1e-9) << kFacePointNames[size_t(i)];
      EXPECT_NEAR(here.y(), there.y(), 1e-9) << kFacePointNames[size_t(i)];
    }
  }
}

TEST(FacePoints, ContoursRunFromTheEarsToTheChin) {
  const FaceTemplate face = FaceWithJaw();
  const auto vertices = FindFacePoints(face);
  const auto& landmarks = face.annotation.landmarks;
  const int chin = landmarks[kChinLandmark];
  EXPECT_EQ(vertices.of_points[size_t(FacePoint::kChin)], std::vector<int>{chin});
  EXPECT_EQ(vertices.contours[0], (std::vector<int>{landmarks[0], landmarks[1], landmarks[2], landmarks[4],
                                                    landmarks[5], landmarks[6], landmarks[7], chin}));
  EXPECT_EQ(vertices.contours[1].front(), landmarks[16]);
  EXPECT_EQ(vertices.contours[1].back(), chin);
}

TEST(FacePoints, OfAContourIsTheNearestPointOfItsPolyline) {
  Eigen::MatrixX2d line(3, 2);
  line << 0, 0, 4, 0, 4, 4;
  const PolylinePlace place = NearestOnPolyline({0, 1, 2}, line, {5, 1});
  EXPECT_EQ(place.from, 1);
  EXPECT_EQ(place.to, 2);
  EXPECT_DOUBLE_EQ(place.share, 0.25);
  EXPECT_DOUBLE_EQ(NearestOnPolyline({0, 1, 2}, line, {-3, 2}).share, 0) << "ends are not extended";
  testing::ExpectError([&] { NearestOnPolyline({}, line, {0, 0}); }, "a contour without vertices");
}

TEST(FacePoints, NeedAllLandmarks) {
  FaceTemplate face = testing::SyntheticFace();
  face.annotation.landmarks[48] = -1;
  testing::ExpectError([&] { FindFacePoints(face); }, "no landmark 48");
}

}  // namespace
}  // namespace daumier::faces
