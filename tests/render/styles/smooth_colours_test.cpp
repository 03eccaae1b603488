#include "render/styles/surface_colours.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;

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

TEST(WithClay, IsOneAlbedoWhereCovered) {
  const PictureLayers layers = WithClay(MakePictureLayers(BallHead()), {0.5f, 0.6f, 0.7f});
  EXPECT_EQ(layers.albedo[1].at(32, 32), 0.6f);
  EXPECT_EQ(layers.albedo[1].at(29, 40), 0.6f) << "an eye";
  EXPECT_EQ(layers.albedo[1].at(1, 1), 0);
}

}  // namespace
}  // namespace daumier::render
