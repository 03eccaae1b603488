#include "systems/portrait/toon_portrait.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace daumier::portrait {
namespace {

/// 68 landmarks of which the eyes, 24 pixels wide, are about (70, 60) and (130, 60).
std::vector<float> Landmarks() {
  std::vector<float> landmarks(136, 100);
  constexpr std::array<std::array<float, 2>, 6> kEye = {{{-12, 0}, {-6, -4}, {6, -4}, {12, 0}, {6, 4}, {-6, 4}}};
  for (size_t eye = 0; eye < 2; ++eye) {
    for (size_t n = 0; n < 6; ++n) {
      landmarks[2 * (36 + 6 * eye + n)] = (eye == 0 ? 70.0F : 130.0F) + kEye[n][0];
      landmarks[2 * (36 + 6 * eye + n) + 1] = 60 + kEye[n][1];
    }
  }
  return landmarks;
}

/// White but for black discs of radius 4 in the eyes.
render::Image Eyes() {
  render::Image picture(200, 200, 3);
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column)
      for (const double x : {70.0, 130.0})
        if (std::hypot(column + 0.5 - x, row + 0.5 - 60) < 4)
          for (int c = 0; c < 3; ++c) picture.at(row, column, c) = 0;
  return picture;
}

int NumDark(const render::Image& picture) {
  int count = 0;
  for (size_t i = 0; i < picture.pixels.size(); i += size_t(picture.channels)) count += picture.pixels[i] < 128;
  return count;
}

const ToonPortraitOptions kSharp = {.colours = {.reach = 0, .bands = 0, .saturation = 1}, .eyes = 0.4};

TEST(ToonPortrait, ShowsEyesLargerAndMovesTheirLandmarks) {
  const ToonPortrait toon = MakeToonPortrait(Eyes(), Landmarks(), nullptr, kSharp);
  // By nearly 1 / 0.6 in both directions in the middle of the disc.
  EXPECT_GT(NumDark(toon.picture), 1.8 * NumDark(Eyes()));
  EXPECT_LT(NumDark(toon.picture), 3.0 * NumDark(Eyes()));
  // The upper lid's landmark (64, 56) is farther from the middle now, on the same ray; the nose stays.
  const double x = toon.landmarks[2 * 37], y = toon.landmarks[2 * 37 + 1];
  EXPECT_LT(y, 55);
  EXPECT_NEAR((x - 70) / (y - 60), 1.5, 0.01);
  EXPECT_EQ(toon.landmarks[2 * 30], 100);
}

TEST(ToonPortrait, MovesTheMaskAsThePicture) {
  render::Image mask(200, 200, 1, 0);
  const render::Image eyes = Eyes();
  for (size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = eyes.pixels[3 * i] < 128 ? 3 : 1;
  const ToonPortrait toon = MakeToonPortrait(eyes, Landmarks(), &mask, kSharp);
  ASSERT_TRUE(toon.mask);
  int num_wrong = 0;
  for (size_t i = 0; i < mask.pixels.size(); ++i) {
    EXPECT_TRUE(toon.mask->pixels[i] == 1 || toon.mask->pixels[i] == 3);
    num_wrong += (toon.mask->pixels[i] == 3) != (toon.picture.pixels[3 * i] < 128);
  }
  EXPECT_LE(num_wrong, 20) << "the picture is between pixels at the border, the mask is not";
}

TEST(ToonPortrait, LeavesWhatIsOutsideOfTheEyes) {
  render::Image picture = Eyes();
  picture.at(150, 150, 0) = 7;
  const ToonPortrait toon = MakeToonPortrait(picture, Landmarks(), nullptr, kSharp);
  EXPECT_EQ(toon.picture.at(150, 150, 0), 7);
  EXPECT_EQ(MakeToonPortrait(picture, Landmarks(), nullptr, {.colours = kSharp.colours, .eyes = 0}).picture, picture);
}

TEST(ToonPortrait, NeedsAllLandmarks) {
  daumier::testing::ExpectError([] { MakeToonPortrait(Eyes(), std::vector<float>(10), nullptr); }, "68 landmarks");
}

}  // namespace
}  // namespace daumier::portrait
