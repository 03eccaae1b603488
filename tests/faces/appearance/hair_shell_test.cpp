#include "faces/appearance/hair_shell.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(HairShell, WavesAreDeterministicAndFadeToTheCrown) {
  const HairWaves a(5), b(5), c(6);
  EXPECT_EQ(a.At(40, 0.7), b.At(40, 0.7));
  EXPECT_NE(a.At(40, 0.7), c.At(40, 0.7));
  EXPECT_EQ(a.At(40, 0), 0);
  EXPECT_NEAR(a.At(-180, 0.5), a.At(180, 0.5), 1e-9) << "whole numbers of periods";
}

TEST(HairShell, StylesDifferAsTheirNamesSay) {
  const Scalp scalp(testing::SyntheticFace());
  const auto shape_of = [&](HairStyle style, Looks& looks) {
    looks.hair = style;
    return HairShape(scalp.lines(), looks, 1);
  };
  Looks looks;
  EXPECT_GT(shape_of(HairStyle::kReceding, looks).EndAt(30), shape_of(HairStyle::kShort, looks).EndAt(30));
  EXPECT_LT(shape_of(HairStyle::kFringe, looks).EndAt(0), shape_of(HairStyle::kShort, looks).EndAt(0));
  EXPECT_GT(shape_of(HairStyle::kLong, looks).HangAt(180), shape_of(HairStyle::kBob, looks).HangAt(180));
  EXPECT_EQ(shape_of(HairStyle::kShort, looks).HangAt(180), 0);
  EXPECT_EQ(shape_of(HairStyle::kLong, looks).HangAt(0), 0) << "the face is free";
  EXPECT_EQ(shape_of(HairStyle::kBald, looks).HeightAt(0, 60), 0);
  for (size_t style = 0; style < kHairStyleNames.size(); ++style) {
    const HairShape shape = shape_of(static_cast<HairStyle>(style), looks);
    EXPECT_NEAR(shape.HeightAt(0, 90), shape.HeightAt(120, 90), 1e-9) << "the crown has one height";
  }
}

}  // namespace
}  // namespace daumier::faces
