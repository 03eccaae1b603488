#include "render/styles/light_layers.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;
using daumier::testing::ShadeRamp;

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
  PictureLayers layers = MakePictureLayers(buffers);
  layers.scale = 1;
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
