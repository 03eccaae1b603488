#include "rig/mouth_shares.h"

#include "faces/open_mouth.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(MouthShares, OfTheLeftSideAreThoseOfTheRightMirrored) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const Eigen::VectorXf left = ShareOfLeftSide(face);
  for (int v = 0; v < left.size(); ++v) {
    EXPECT_NEAR(left[v] + left[face.annotation.mirror[size_t(v)]], 1, 1e-6);
    if (face.neutral(v, 0) > 5) {
      EXPECT_EQ(left[v], 1);
    }
  }
}

TEST(MouthShares, OfTheUpperLipAreOneOnItsContour) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const Eigen::VectorXf upper = ShareOfUpperLip(face);
  const faces::LipContours lips = faces::FindLipContours(face);
  for (size_t i = 1; i + 1 < lips.upper.size(); ++i) EXPECT_EQ(upper[lips.upper[i]], 1);
  for (size_t i = 1; i + 1 < lips.lower.size(); ++i) EXPECT_EQ(upper[lips.lower[i]], 0);
  EXPECT_EQ(upper[lips.upper.front()], 0.5f);
}

TEST(MouthShares, OfTheLipsAreOneThereAndNothingAtTheChin) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const Eigen::VectorXf lips = ShareOfLips(face);
  const auto& landmarks = face.annotation.landmarks;
  for (const int l : {57, 60, 62, 64, 66}) EXPECT_EQ(lips[landmarks[size_t(l)]], 1) << l;
  EXPECT_EQ(lips[landmarks[8]], 0);
}

}  // namespace
}  // namespace daumier::rig
