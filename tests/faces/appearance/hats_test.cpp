#include "faces/appearance/hats.h"

#include "faces/appearance/scalp.h"
#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Hats, AreClosedAndPressHairUnderThem) {
  const FaceTemplate face = testing::SyntheticFace();
  const Scalp scalp(face);
  const SkullGrid skull = scalp.GridOf(face.neutral);
  for (size_t style = 1; style < kHatStyleNames.size(); ++style) {
    Looks looks;
    looks.hat = static_cast<HatStyle>(style);
    const HatFit fit(looks.hat, scalp.lines(), 1);
    HeadSoup soup = testing::EmptySoup();
    AddHat(skull, fit, 1, looks, soup);
    const PortraitHead hat = soup.Take();
    testing::ExpectClosedSoup(hat);
    EXPECT_GT(testing::VolumeOf(hat), 50) << kHatStyleNames[style];
    EXPECT_GT(fit.BorderAt(0), scalp.lines().brow) << "brows are free";
    EXPECT_LT(fit.Pressed(3, 0, 80), fit.Offset(0, 80));
    EXPECT_EQ(fit.Pressed(3, 0, fit.BorderAt(0) - 20), 3) << "below the hat";
  }
  EXPECT_FALSE(HatFit(HatStyle::kNone, scalp.lines(), 1).is_there());
  EXPECT_EQ(HatFit(HatStyle::kNone, scalp.lines(), 1).Pressed(3, 0, 80), 3);
}

}  // namespace
}  // namespace daumier::faces
