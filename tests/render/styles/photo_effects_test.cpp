#include "render/styles/photo_effects.h"

#include "render/styles/jpeg_loss.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

Image ColourfulPicture(int height = 40, int width = 56) {
  Image image(height, width, 3);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.at(row, column, 0) = static_cast<uint8_t>(255 * column / width);
      image.at(row, column, 1) = static_cast<uint8_t>(255 * row / height);
      image.at(row, column, 2) = (row / 8 + column / 8) % 2 ? 200 : 40;
    }
  }
  return image;
}

Image Effected(const Image& image, const PhotoEffects& effects) {
  Rng rng(4);
  return ApplyPhotoEffects(image, effects, rng);
}

double MeanOf(const Image& image) {
  double sum = 0;
  for (const uint8_t value : image.pixels) sum += value;
  return sum / static_cast<double>(image.pixels.size());
}

double RootMeanSquare(const Image& first, const Image& second) {
  double sum = 0;
  for (size_t i = 0; i < first.pixels.size(); ++i) sum += std::pow(double(first.pixels[i]) - second.pixels[i], 2);
  return std::sqrt(sum / static_cast<double>(first.pixels.size()));
}

TEST(ApplyPhotoEffects, WithoutEffectsReturnsTheSameBytes) {
  EXPECT_EQ(Effected(ColourfulPicture(), {}), ColourfulPicture());
  for (const PhotoEffectOptions& options : {PhotoEffectOptions{.strength = 0}, PhotoEffectOptions{.share = 0}}) {
    Rng rng(1);
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(Effected(ColourfulPicture(), DrawPhotoEffects(rng, options)), ColourfulPicture());
    }
  }
}

TEST(ApplyPhotoEffects, EachEffectChangesThePictureAndKeepsItsSize) {
  std::vector<PhotoEffects> all(10);
  all[0].downscale = 2;
  all[1].blur = 3;
  all[2].sharpen = 1;
  all[3].cast = {1, 0.8f, 0.9f};
  all[4].contrast = 0.7f;
  all[5].gamma = 1.3f;
  all[6].vignette = 0.6f;
  all[7].glare = 0.5f;
  all[8].moire = 0.1f;
  all[9].noise = 0.05f;
  for (const PhotoEffects& effects : all) {
    const Image changed = Effected(ColourfulPicture(), effects);
    EXPECT_EQ(changed.height, 40);
    EXPECT_EQ(changed.width, 56);
    EXPECT_GT(RootMeanSquare(changed, ColourfulPicture()), 1) << &effects - all.data();
    EXPECT_LT(RootMeanSquare(changed, ColourfulPicture()), 60) << &effects - all.data();
    EXPECT_EQ(changed, Effected(ColourfulPicture(), effects));
  }
}

TEST(ApplyPhotoEffects, HasTheValuesWorkedOutByHand) {
  const Image grey(1, 1, 3, 153);  // 0.6
  PhotoEffects effects;
  effects.cast = {0.5f, 1, 1};
  effects.contrast = 0.5f;
  effects.brightness = 0.1f;
  // (0.3 - 0.5) 0.5 + 0.6 = 0.5 and (0.6 - 0.5) 0.5 + 0.6 = 0.65.
  EXPECT_EQ(Effected(grey, effects).pixels, (std::vector<uint8_t>{128, 166, 166}));
  effects = {};
  effects.gamma = 2;
  EXPECT_EQ(Effected(grey, effects).pixels[0], 92) << "0.36";
}

TEST(ApplyPhotoEffects, NoiseHasItsDeviationAndIsGrey) {
  const Image grey(200, 200, 3, 128);
  PhotoEffects effects;
  effects.noise = 0.05f;
  const Image noisy = Effected(grey, effects);
  EXPECT_NEAR(MeanOf(noisy), 128, 0.5);
  EXPECT_NEAR(RootMeanSquare(noisy, grey), 0.05 * 255, 0.3);
  for (size_t i = 0; i < noisy.pixels.size(); i += 3) ASSERT_EQ(noisy.pixels[i], noisy.pixels[i + 2]);
}

TEST(ApplyPhotoEffects, RefusesWhatItCannotDo) {
  PhotoEffects effects;
  daumier::testing::ExpectError([&] { Effected(Image(4, 4, 1), effects); }, "1 channels");
  daumier::testing::ExpectError([&] { Effected(Image(0, 4, 3), effects); }, "0 x 4");
  effects.downscale = 0.5f;
  daumier::testing::ExpectError([&] { Effected(Image(4, 4, 3), effects); }, "downscale");
  effects = {};
  effects.jpeg_quality = 101;
  daumier::testing::ExpectError([&] { Effected(Image(4, 4, 3), effects); }, "jpeg_quality");
}

TEST(DrawPhotoEffects, AllOfThemArePossibleAndInRange) {
  Rng rng(9);
  int with_jpeg = 0, with_any = 0;
  for (int i = 0; i < 400; ++i) {
    const PhotoEffects effects = DrawPhotoEffects(rng, {.strength = 3, .share = 1, .screen = 0.5});
    with_jpeg += effects.jpeg_quality > 0 ? 1 : 0;
    with_any += Effected(ColourfulPicture(9, 11), effects) != ColourfulPicture(9, 11) ? 1 : 0;
  }
  EXPECT_NEAR(with_jpeg, 200, 40);
  EXPECT_GT(with_any, 350);
}

TEST(JpegLoss, ShrinksWithTheQuality) {
  const Image picture = ColourfulPicture();
  double last = 0;
  for (const int quality : {100, 90, 60, 30, 8}) {
    const double loss = RootMeanSquare(JpegLoss(picture, quality), picture);
    EXPECT_GT(loss, last) << quality;
    last = loss;
  }
  EXPECT_LT(RootMeanSquare(JpegLoss(Image(17, 9, 3, 77), 90), Image(17, 9, 3, 77)), 1.01);
  daumier::testing::ExpectError([&] { JpegLoss(picture, 0); }, "quality is 0");
  daumier::testing::ExpectError([&] { JpegLoss(Image(8, 8, 1), 50); }, "1 channels");
}

TEST(JpegLoss, OfOneCosineIsItsRoundedCoefficient) {
  // 128 + 20 cos((2 i + 1) pi / 16) down a block: one coefficient, 20 * 4 * sqrt(1/2) * ... = 20 * 8 * 0.5 * 0.5 * sqrt(2).
  Image image(8, 8, 3);
  for (int row = 0; row < 8; ++row) {
    const auto value = static_cast<uint8_t>(std::lround(128 + 20 * std::cos((2 * row + 1) * 3.14159265358979 / 16)));
    for (int i = 0; i < 24; ++i) image.pixels[size_t(row) * 24 + i] = value;
  }
  // 113.1 is a multiple of 2 (step 12 at quality 92: (12 * 16 + 50) / 100 = 2) to within 1: the picture comes back.
  const Image back = JpegLoss(image, 92);
  for (size_t i = 0; i < back.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i], image.pixels[i], 2);
}

}  // namespace
}  // namespace daumier::render
