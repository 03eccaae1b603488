#include "faces/appearance/skin_fields.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(SkinFields, OfLipsAndBrowsLieWhereTheLandmarksAre) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto& landmarks = face.annotation.landmarks;
  const Eigen::VectorXd lips = LipIndicator(face);
  for (size_t l = 48; l < 68; ++l) EXPECT_EQ(lips[landmarks[l]], 1) << l;
  for (const size_t l : {8, 30, 33, 36, 2, 14}) EXPECT_EQ(lips[landmarks[l]], 0) << l;
  const Eigen::VectorXd brows = SkinField(face, "brows");
  EXPECT_GT(brows[landmarks[19]], 0.9);
  EXPECT_EQ(brows[landmarks[30]], 0);
  for (const char* name : {"skin", "lips", "upper_lip", "cheeks", "beard", "scalp", "freckles", "ears", "neck"}) {
    const Eigen::VectorXd field = SkinField(face, name);
    EXPECT_GE(field.minCoeff(), 0) << name;
    EXPECT_LE(field.maxCoeff(), 1) << name;
  }
  EXPECT_GT(SkinField(face, "scalp")[face.num_vertices() - 1], 0.99) << "the crown";
  EXPECT_EQ(SkinField(face, "scalp")[landmarks[30]], 0);
  testing::ExpectError([&] { SkinField(face, "elbow"); }, "elbow");
}

}  // namespace
}  // namespace daumier::faces
