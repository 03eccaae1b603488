#include "fitting/texture_iris.h"

#include "tests/fitting/drawn_eye.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

TEST(FindIris, FindsTheDarkDisc) {
  const IrisDisc iris{{88, 76}, 14};
  const auto found = FindIris(DrawnEye({80, 80}, iris), {80, 80}, 48);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->centre.x(), 88, 2);
  EXPECT_NEAR(found->centre.y(), 76, 2);
  EXPECT_NEAR(found->radius, 14, 2.5);
}

TEST(FindIris, FindsItWhereALidHidesItsUpperPart) {
  const auto found = FindIris(DrawnEye({80, 80}, {{74, 80}, 15}, 76), {80, 80}, 48);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->centre.x(), 74, 2);
  EXPECT_NEAR(found->centre.y(), 80, 4);
}

TEST(FindIris, FindsNoneInAClosedOrAnEvenEye) {
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{80, 80}, 14}, 103), {80, 80}, 48)) << "closed but for a line";
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{300, 300}, 1}), {80, 80}, 48)) << "white alone";
  EXPECT_FALSE(FindIris(DrawnEye({80, 80}, {{80, 80}, 14}), {10, 10}, 18)) << "elsewhere";
}

TEST(FindIris, IsNotThePupilOfAPaleEye) {
  PictureLayer layer = DrawnEye({80, 80}, {{80, 80}, 18});
  for (float& value : layer.colours)
    if (value < 0.45F) value = 0.6F;
  for (int row = 0; row < kEyeSide; ++row)
    for (int column = 0; column < kEyeSide; ++column)
      if (std::hypot(column + 0.5 - 80, row + 0.5 - 80) < 5)
        for (size_t k = 0; k < 3; ++k) layer.colours[3 * (size_t(row) * kEyeSide + size_t(column)) + k] = 0.05F;
  const auto found = FindIris(layer, {80, 80}, 48);
  ASSERT_TRUE(found);
  EXPECT_GT(found->radius, 11);
}

TEST(IrisProfile, HasTheMedianOfEachRing) {
  const IrisDisc iris{{80, 80}, 14};
  PictureLayer layer = DrawnEye({80, 80}, iris);
  const size_t highlight = 3 * (size_t(80) * kEyeSide + 86);
  std::fill_n(layer.colours.begin() + ptrdiff_t(highlight), 6, 1.0F);
  const IrisProfile profile(layer, iris);
  for (const float share : {0.0F, 0.5F, 0.9F})
    EXPECT_TRUE(profile.At(share).isApprox(Eigen::Vector3f(0.1F, 0.2F, 0.5F), 1e-5F)) << share;
}

TEST(MedianOfEye, IsThatOfKnownPixels) {
  const PictureLayer layer = DrawnEye({80, 80}, {{80, 80}, 14});
  EXPECT_TRUE(MedianOfEye(layer, {80, 80}, 48)->isApprox(Eigen::Vector3f::Constant(0.8F)));
  EXPECT_FALSE(MedianOfEye(layer, {10, 10}, 5)) << "no eye";
}

TEST(WhiteLightness, IsThatOfBrightPixelsOutsideOfTheIris) {
  const IrisDisc iris{{80, 80}, 14};
  const PictureLayer layer = DrawnEye({80, 80}, iris);
  EXPECT_NEAR(WhiteLightness(layer, {80, 80}, 60, iris).value(), 0.8F, 1e-5F);
  EXPECT_FALSE(WhiteLightness(layer, {10, 10}, 5, iris)) << "no eye";
}

}  // namespace
}  // namespace daumier::fitting
