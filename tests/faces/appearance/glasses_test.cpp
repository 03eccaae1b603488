#include "faces/appearance/glasses.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Glasses, AreClosedInFrontOfTheEyesAndSymmetric) {
  const FaceTemplate face = testing::SyntheticFace();
  const GlassesFit fit(face);
  for (size_t style = 1; style < kGlassesStyleNames.size(); ++style) {
    Looks looks;
    looks.glasses = static_cast<GlassesStyle>(style);
    HeadSoup soup = testing::EmptySoup();
    fit.AddGlasses(face.neutral, looks, soup);
    const PortraitHead glasses = soup.Take();
    testing::ExpectClosedSoup(glasses);
    EXPECT_GT(testing::VolumeOf(glasses), 0);
    EXPECT_GT(glasses.vertices.col(2).maxCoeff(), face.neutral(face.annotation.landmarks[43], 2));
    EXPECT_NEAR(glasses.vertices.col(0).minCoeff(), -glasses.vertices.col(0).maxCoeff(), 0.1);
  }
  HeadSoup none = testing::EmptySoup();
  fit.AddGlasses(face.neutral, Looks{}, none);
  EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
