#include "render/styles/surface_colours.h"

#include "render/styles/light_layers.h"
#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::render {
namespace {

using testing::BallHead;

/// A strip of skin whose shade rises from 0 to 1, as wide as it is long.
PictureBuffers ShadeRamp(int width) {
  PictureBuffers buffers = EmptyPictureBuffers(16, width);
  for (size_t i = 0; i < buffers.size(); ++i) {
    buffers.depth[i] = 100;
    buffers.classes[i] = static_cast<uint8_t>(PictureClass::kSkin);
    buffers.shade[i] = static_cast<float>(i % width) / static_cast<float>(width - 1);
    for (int channel = 0; channel < 3; ++channel) buffers.albedo[3 * i + channel] = 0.5f;
  }
  return buffers;
}

TEST(QuantisedLight, HasTheLevelsWorkedOutByHand) {
  EXPECT_EQ(QuantisedLight(0.49f, 2, 0), 0);
  EXPECT_EQ(QuantisedLight(0.51f, 2, 0), 1);
  EXPECT_EQ(QuantisedLight(0.5f, 3, 0), 0.5f);
  EXPECT_EQ(QuantisedLight(0.30f, 3, 0), 0);
  EXPECT_EQ(QuantisedLight(0.70f, 3, 0), 1);
  EXPECT_NEAR(QuantisedLight(0.6f, 4, 0.01f), 2.0f / 3, 1e-6);
  EXPECT_NEAR(QuantisedLight(0.5f, 2, 0.2f), 0.5f, 1e-6) << "the middle of a soft step";
  EXPECT_NEAR(QuantisedLight(0.45f, 2, 0.2f), 0.15625f, 1e-6) << "a quarter: 3 / 16 - 2 / 64";
  EXPECT_EQ(QuantisedLight(-3, 3, 0.1f), 0);
  EXPECT_EQ(QuantisedLight(9, 3, 0.1f), 1);
}

TEST(ToonLight, OfARampIsItsBands) {
  StyleChoice choice;
  choice.shadows = 0;
  choice.band_softness = 0.02f;
  const PictureLayers layers = MakePictureLayers(ShadeRamp(200));
  for (const int bands : {2, 3, 4}) {
    choice.bands = bands;
    const Plane light = ToonLight(layers, choice);
    std::set<int> levels;
    for (int column = 0; column < 200; ++column) {
      const float level = light.at(8, column) * static_cast<float>(bands - 1);
      if (std::abs(level - std::round(level)) < 1e-3f) levels.insert(static_cast<int>(std::round(level)));
      if (column > 0) {
        EXPECT_GE(light.at(8, column), light.at(8, column - 1));
      }
    }
    EXPECT_EQ(levels.size(), size_t(bands));
    EXPECT_EQ(light.at(8, 5), 0);
    EXPECT_EQ(light.at(8, 195), 1);
  }
}

TEST(ToonColours, ShadowsHaveTheGivenHue) {
  StyleChoice choice;
  choice.shadows = 0;
  choice.band_depth = 0.4f;
  choice.shadow_hue = {1, 0.8f, 0.9f};
  const ColourPlanes colours = ToonColours(MakePictureLayers(ShadeRamp(200)), choice);
  const float lit = colours[0].at(8, 195);
  EXPECT_NEAR(colours[0].at(8, 5), lit * 0.6f, 1e-4);
  EXPECT_NEAR(colours[1].at(8, 5), lit * 0.6f * 0.8f, 1e-4);
  EXPECT_NEAR(colours[2].at(8, 5), lit * 0.6f * 0.9f, 1e-4);
  EXPECT_EQ(colours[1].at(8, 195), lit);
}

TEST(SmoothColours, WithoutExtrasIsAlbedoTimesShade) {
  StyleChoice choice;
  choice.key = choice.rim = choice.gloss = choice.occlusion = choice.shadows = choice.warm_shade = 0;
  const PictureLayers layers = MakePictureLayers(BallHead());
  const ColourPlanes colours = SmoothColours(layers, choice);
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < layers.size(); ++i) {
      const float product = layers.albedo[channel].values[i] * layers.shade.values[i];
      if (product < 0.85f) {
        ASSERT_NEAR(colours[channel].values[i], product, 1e-6);
      } else {
        ASSERT_GT(colours[channel].values[i], 0.84f);
        ASSERT_LT(colours[channel].values[i], 1);
      }
    }
  }
}

TEST(FlatColours, HaveOneColourARegionAndKeepEyes) {
  const PictureLayers layers = MakePictureLayers(BallHead());
  const ColourPlanes colours = FlatColours(layers);
  EXPECT_EQ(colours[0].at(32, 20), colours[0].at(32, 44)) << "both cheeks";
  EXPECT_NEAR(colours[0].at(32, 32), 0.8f, 0.01);
  EXPECT_NEAR(colours[1].at(29, 40), 0.35f, 0.01) << "the left iris, 3.2 cm from the middle and 1 cm above it";
  EXPECT_NEAR(colours[1].at(42, 32), 0.35f, 0.05) << "lips, 4 cm below the middle";
  EXPECT_EQ(colours[0].at(1, 1), 0) << "not covered";
}

TEST(MainLight, IsTheDirectionOfTheShade) {
  const auto light = MainLight(MakePictureLayers(BallHead()));
  EXPECT_NEAR(light[0], -0.501, 0.01);
  EXPECT_NEAR(light[1], 0.602, 0.01);
  EXPECT_NEAR(light[2], 0.622, 0.01);
  PictureBuffers even = BallHead();
  for (float& shade : even.shade) shade = 0.7f;
  EXPECT_NEAR(MainLight(MakePictureLayers(even))[0], -0.501, 1e-6) << "the usual one";
}

TEST(Occlusion, IsWhatLiesBehindItsSurroundings) {
  PictureBuffers buffers = ShadeRamp(64);
  for (int row = 0; row < 16; ++row) {
    for (int column = 30; column < 34; ++column) buffers.depth[size_t(row) * 64 + column] = 103;
  }
  const PictureLayers layers = MakePictureLayers(buffers);
  const Plane occlusion = Occlusion(layers);
  EXPECT_GT(occlusion.at(8, 32), 0.5f);
  EXPECT_EQ(occlusion.at(8, 5), 0);
}

TEST(CastShadows, FallAwayFromTheLight) {
  // A box 4 cm before a wall, light from the left.
  PictureBuffers buffers = ShadeRamp(64);
  buffers.pixels_per_cm = 4;
  for (int row = 0; row < 16; ++row) {
    for (int column = 20; column < 26; ++column) buffers.depth[size_t(row) * 64 + column] = 98;
  }
  const Plane shadow = CastShadows(MakePictureLayers(buffers), {-0.8f, 0, 0.6f});
  EXPECT_GT(shadow.at(8, 29), 0.8f) << "right of it";
  EXPECT_EQ(shadow.at(8, 15), 0) << "left of it";
  EXPECT_LT(shadow.at(8, 50), 0.1f) << "2 cm before the wall, it reaches less than 3 cm";
}

}  // namespace
}  // namespace daumier::render
