#include "fitting/texture_picture.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::fitting {
namespace {

/// Grey colours, three channels each.
std::vector<float> Greys(const std::vector<float>& values) {
  std::vector<float> colours;
  for (const float value : values) colours.insert(colours.end(), 3, value);
  return colours;
}

TEST(DiffuseColours, TakesTheMeanOfKnownNeighboursBreadthFirst) {
  // Known are the outer columns; the middle is reached from both sides in one level.
  std::vector<float> colours = Greys({0, 9, 1, 0.5F, 9, 0.5F});
  const std::vector<uint8_t> known = {1, 0, 1, 1, 0, 1};
  DiffuseColours(2, 3, known, colours);
  EXPECT_EQ(colours, Greys({0, 0.5F, 1, 0.5F, 0.5F, 0.5F}));
}

TEST(DiffuseColours, OfALaterLevelSeesTheLevelsBefore) {
  std::vector<float> colours = Greys({0.25F, 9, 9, 9});
  DiffuseColours(1, 4, std::vector<uint8_t>{1, 0, 0, 0}, colours);
  EXPECT_EQ(colours, Greys({0.25F, 0.25F, 0.25F, 0.25F}));
}

TEST(DiffuseColours, IsTheMirrorImageForTheMirrorImage) {
  constexpr int kHeight = 9, kWidth = 14;
  std::vector<float> colours(size_t(3 * kHeight * kWidth)), mirrored = colours;
  std::vector<uint8_t> known(size_t(kHeight) * kWidth), known_mirrored = known;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const size_t at = size_t(row) * kWidth + size_t(column),
                   other = size_t(row) * kWidth + size_t(kWidth - 1 - column);
      known[at] = known_mirrored[other] = (row * 5 + column * 3) % 11 == 0;
      for (size_t k = 0; k < 3; ++k)
        colours[3 * at + k] = mirrored[3 * other + k] = float((row * 7 + column * 5 + int(k)) % 8) / 8;
    }
  }
  DiffuseColours(kHeight, kWidth, known, colours);
  DiffuseColours(kHeight, kWidth, known_mirrored, mirrored);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      EXPECT_NEAR(colours[3 * (size_t(row) * kWidth + size_t(column))],
                  mirrored[3 * (size_t(row) * kWidth + size_t(kWidth - 1 - column))], 1e-6);
}

TEST(DiffuseColours, WithoutAKnownPixelChangesNothing) {
  std::vector<float> colours = Greys({0.1F, 0.2F});
  const std::vector<float> before = colours;
  DiffuseColours(1, 2, std::vector<uint8_t>{0, 0}, colours);
  EXPECT_EQ(colours, before);
  testing::ExpectError([&] { DiffuseColours(2, 2, std::vector<uint8_t>{0, 0}, colours); }, "2 x 2");
}

TEST(DistanceFromOutside, CountsStepsAlongAxesAndDiagonals) {
  // One pixel outside, in a corner.
  const std::vector<float> distance = DistanceFromOutside(3, 3, std::vector<uint8_t>{0, 1, 1, 1, 1, 1, 1, 1, 1});
  const float d = 4.0F / 3;
  const std::vector<float> expected = {0, 1, 2, 1, d, 1 + d, 2, 1 + d, 2 * d};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(distance[i], expected[i], 1e-6) << i;
  EXPECT_EQ(DistanceFromOutside(1, 2, std::vector<uint8_t>{1, 1}), (std::vector<float>{3, 3}));
}

TEST(LayerOf, KeepsColoursInsideAndContinuesThemOutside) {
  render::Image picture(5, 20, 3, 0), mask(5, 20, 1, uint8_t(PictureClass::kBackground));
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 20; ++column) {
      const bool is_face = column < 10;
      if (is_face) mask.at(row, column) = uint8_t(PictureClass::kSkin);
      // The last two columns of the face are stained by the background, as by antialiasing.
      for (int k = 0; k < 3; ++k) picture.at(row, column, k) = column < 8 ? 204 : 0;
    }
  }
  const PictureLayer layer = LayerOf(picture, mask, {PictureClass::kSkin}, 2);
  const auto at = [&](int column) { return size_t(2 * 20 + column); };
  for (int column = 0; column < 20; ++column) EXPECT_NEAR(layer.colours[3 * at(column)], 0.8F, 1e-5) << column;
  EXPECT_EQ(layer.confidence[at(15)], 0);
  EXPECT_EQ(layer.confidence[at(9)], 0);
  EXPECT_EQ(layer.confidence[at(2)], 1);
  EXPECT_EQ(layer.num_known, 5 * 8);
}

TEST(LayerOf, RefusesAMaskOfAnotherSize) {
  testing::ExpectError([] { LayerOf(render::Image(2, 2, 3), render::Image(2, 3, 1), {PictureClass::kSkin}, 1); },
                       "expected RGB and grey");
}

TEST(ClassSet, HoldsItsClassesAndNoNumberBeyondThem) {
  const ClassSet set = {PictureClass::kSkin, PictureClass::kHair};
  EXPECT_TRUE(set.holds(uint8_t(PictureClass::kSkin)));
  EXPECT_TRUE(set.holds(uint8_t(PictureClass::kHair)));
  EXPECT_FALSE(set.holds(uint8_t(PictureClass::kEyes)));
  EXPECT_FALSE(set.holds(200));
}

TEST(DoubtOverexposed, TrustsPixelsWithoutAHueLittle) {
  render::Image picture(4, 4, 3, 200), mask(4, 4, 1, uint8_t(PictureClass::kSkin));
  picture.at(1, 2, 0) = 252;
  for (int k = 0; k < 3; ++k) picture.at(1, 3, k) = 241;
  PictureLayer layer = LayerOf(picture, mask, {PictureClass::kSkin}, 0);
  DoubtOverexposed(picture, layer);
  EXPECT_EQ(layer.confidence[5], 1);
  EXPECT_NEAR(layer.confidence[6], 0.1F, 1e-6);
  EXPECT_EQ(layer.confidence[7], 0) << "white";
  const render::Image white(4, 4, 3, 245);
  PictureLayer pale = LayerOf(white, mask, {PictureClass::kSkin}, 0);
  DoubtOverexposed(white, pale);
  EXPECT_EQ(pale.confidence[7], 1) << "a face that is drawn white";
  testing::ExpectError([&] { DoubtOverexposed(render::Image(2, 2, 3), layer); }, "2 x 2");
}

}  // namespace
}  // namespace daumier::fitting
