#include "render/styles/surface_colours.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;
using daumier::testing::ShadeRamp;

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

TEST(FlatColours, HaveOneColourARegionAndKeepEyes) {
  const PictureLayers layers = MakePictureLayers(BallHead());
  const ColourPlanes colours = FlatColours(layers);
  EXPECT_EQ(colours[0].at(38, 20), colours[0].at(38, 44)) << "both cheeks";
  EXPECT_NEAR(colours[0].at(32, 32), 0.8f, 0.01);
  EXPECT_NEAR(colours[1].at(29, 40), 0.35f, 0.01) << "the left iris, 3.2 cm from the middle and 1 cm above it";
  EXPECT_NEAR(colours[1].at(42, 32), 0.35f, 0.05) << "lips, 4 cm below the middle";
  EXPECT_EQ(colours[0].at(1, 1), 0) << "not covered";
}

}  // namespace
}  // namespace daumier::render
