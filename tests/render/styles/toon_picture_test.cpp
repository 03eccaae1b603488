#include "render/styles/toon_picture.h"

#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

/// Left half grey of 60, right half of 200, with a chequer of +-`noise` on both.
Image TwoHalves(int noise) {
  Image picture(40, 60, 1);
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      picture.at(row, column) = uint8_t((column < 30 ? 60 : 200) + ((row + column) % 2 == 0 ? noise : -noise));
  return picture;
}

TEST(ToonPicture, LeavesOneColourAsItIs) {
  const Image toon = ToonPicture(Image(20, 30, 3, 128), {.bands = 0});
  EXPECT_EQ(toon.channels, 3);
  for (const uint8_t value : toon.pixels) EXPECT_EQ(value, 128);
}

TEST(ToonPicture, SmoothsWithinBordersAndKeepsThem) {
  const Image toon = ToonPicture(TwoHalves(8), {.reach = 0.3, .contrast = 0.3, .bands = 0});
  for (const int column : {4, 26}) EXPECT_NEAR(toon.at(20, column), 60, 3) << column;
  for (const int column : {33, 56}) EXPECT_NEAR(toon.at(20, column), 200, 3) << column;
}

TEST(ToonPicture, BandsDrawLightnessTowardsTheirMiddles) {
  // Of 4 bands those of 0.3 and 0.7 have their middles at 0.375 and 0.625, borders at 0.25 and 0.75:
  // 0.25 + 0.125 tanh(4 * 0.05 / 0.25) / tanh(2) = 0.3361.
  Image picture(2, 2, 1, uint8_t(std::lround(0.3 * 255)));
  const double y = std::lround(0.3 * 255) / 255.0;
  const double expected = 0.25 + 0.125 * std::tanh(4 * (y - 0.25) / 0.25) / std::tanh(2.0);
  EXPECT_NEAR(ToonPicture(picture, {.reach = 0, .bands = 4}).at(0, 0) / 255.0, expected, 1.0 / 255);
  picture.pixels.assign(4, 255);
  EXPECT_EQ(ToonPicture(picture, {.reach = 0, .bands = 4}).at(0, 0), 255);
}

TEST(ToonPicture, SaturationStretchesColoursFromGrey) {
  Image picture(1, 1, 3);
  picture.pixels = {150, 100, 100};
  const Image toon = ToonPicture(picture, {.reach = 0, .bands = 0, .saturation = 2});
  // Y = 0.299 * 150 + 0.701 * 100 = 114.95.
  EXPECT_NEAR(toon.at(0, 0, 0), 114.95 + 2 * 35.05, 1);
  EXPECT_NEAR(toon.at(0, 0, 1), 114.95 - 2 * 14.95, 1);
}

TEST(ToonPicture, IsTheSameFromSeveralThreads) {
  daumier::testing::ExpectTheSameFromThreads(3, [] { return ToonPicture(TwoHalves(8)); });
}

TEST(ToonPicture, RefusesAnEmptyPicture) {
  daumier::testing::ExpectError([] { ToonPicture(Image()); }, "it is empty");
}

}  // namespace
}  // namespace daumier::render
