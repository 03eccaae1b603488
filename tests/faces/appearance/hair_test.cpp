#include "faces/appearance/hair.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Hair, OfEveryStyleIsClosedAndOutsideOfTheSkull) {
  const FaceTemplate face = testing::SyntheticFace();
  const Scalp scalp(face);
  const SkullGrid skull = scalp.GridOf(face.neutral);
  for (size_t style = 1; style < kHairStyleNames.size(); ++style) {
    Looks looks;
    looks.hair = static_cast<HairStyle>(style);
    const HatFit none(HatStyle::kNone, scalp.lines(), 1);
    HeadSoup soup = testing::EmptySoup();
    AddHair(skull, scalp.lines(), none, 1, looks, soup);
    const PortraitHead hair = soup.Take();
    testing::ExpectClosedSoup(hair);
    EXPECT_GT(testing::VolumeOf(hair), 50) << kHairStyleNames[style];
    EXPECT_GT(hair.vertices.col(1).maxCoeff(), face.neutral.col(1).maxCoeff()) << "over the crown";
    EXPECT_TRUE(hair.vertices.allFinite());
  }
  Looks bald;
  bald.hair = HairStyle::kBald;
  HeadSoup soup = testing::EmptySoup();
  AddHair(skull, scalp.lines(), HatFit(HatStyle::kNone, scalp.lines(), 1), 1, bald, soup);
  EXPECT_EQ(soup.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
