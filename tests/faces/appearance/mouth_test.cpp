#include "faces/appearance/mouth.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Mouth, HasTeethOnlyWhereLipsAreApart) {
  const FaceTemplate face = testing::SyntheticFace();
  const LipContours lips = FindLipContours(face);
  HeadSoup open = testing::EmptySoup();
  AddTeeth(lips, OpenMouth(face, 2.0), open);
  const PortraitHead teeth = open.Take();
  testing::ExpectClosedSoup(teeth);
  EXPECT_GT(testing::VolumeOf(teeth), 0);
  geometry::Points closed = face.neutral;
  for (const int v : lips.lower) closed(v, 1) = closed(lips.upper.front(), 1);
  for (const int v : lips.upper) closed(v, 1) = closed(lips.upper.front(), 1);
  HeadSoup none = testing::EmptySoup();
  AddTeeth(lips, closed, none);
  EXPECT_EQ(none.size(), 0);
}

}  // namespace
}  // namespace daumier::faces
