#include "fitting/texture_projection.h"

#include "tests/fitting/small_atlas.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::fitting {
namespace {

constexpr int kProjectedSize = 64;

/// A picture of 224 x 224 whose red rises to the right and whose green rises downwards.
PictureLayer Ramps() {
  PictureLayer layer{224, 224, std::vector<float>(3 * 224 * 224), std::vector<float>(224 * 224, 1.0F), 224 * 224};
  for (int row = 0; row < 224; ++row) {
    for (int column = 0; column < 224; ++column) {
      float* const c = layer.colours.data() + 3 * (size_t(row) * 224 + size_t(column));
      c[0] = (float(column) + 0.5F) / 224, c[1] = (float(row) + 0.5F) / 224;
    }
  }
  return layer;
}

geometry::Points Turned(const geometry::Points& points, double yaw) {
  PortraitPose pose = PortraitPose::Zero();
  pose[1] = yaw;
  return Posed(points, pose);
}

TEST(FindTexelSights, PutsATexelWhereItsPointIsProjected) {
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(kProjectedSize);
  PictureCamera camera;
  camera.linear << 0, -2, 2, 0;  // A quarter turn, twice as large.
  camera.shift << 500, 10;
  const auto sights = FindTexelSights(sheet.space, texels, sheet.vertices, camera);
  const int texel = sheet.TexelAt(texels, 3, -2);
  // The middle of that texel, on the sheet.
  const double x = ((texel % kProjectedSize + 0.5) / kProjectedSize - 0.5) / 0.4 * 6,
               y = (0.5 - (texel / kProjectedSize + 0.5) / kProjectedSize) / 0.4 * 6;
  const double in_view_x = 112 + 10.15 * x, in_view_y = 112 - 10.15 * y;
  EXPECT_NEAR(sights[size_t(texel)].place.x(), 500 - 2 * in_view_y, 1e-3);
  EXPECT_NEAR(sights[size_t(texel)].place.y(), 10 + 2 * in_view_x, 1e-3);
  EXPECT_EQ(sights[size_t(texel)].sight, 1);
  EXPECT_EQ(sights[0].sight, 0) << "of no triangle";
}

TEST(FindTexelSights, SeesNothingOfWhatTurnsAway) {
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(kProjectedSize);
  const int middle = sheet.TexelAt(texels, 0.1, 0.1);
  const auto sight_at = [&](double degrees) {
    const auto posed = Turned(sheet.vertices, degrees * std::numbers::pi / 180);
    return FindTexelSights(sheet.space, texels, posed, {})[size_t(middle)].sight;
  };
  EXPECT_EQ(sight_at(0), 1);
  EXPECT_GT(sight_at(70), 0.05F);
  EXPECT_LT(sight_at(70), 0.9F);
  EXPECT_EQ(sight_at(88), 0);
  EXPECT_EQ(sight_at(180), 0);
}

TEST(FindTexelSights, SeesNothingBehindAnotherSurface) {
  // A ridge across the middle hides what is behind it from the side; the sheet is seen from the left.
  const Sheet sheet = Sheet::Make(32, 6, [](double x, double) { return 3 * std::exp(-x * x / 0.5); });
  const rig::TexelMap texels = sheet.space.Rasterise(128);
  const auto posed = Turned(sheet.vertices, 50 * std::numbers::pi / 180);  // The face's left side comes to the viewer.
  const auto sights = FindTexelSights(sheet.space, texels, posed, {});
  // z to x: the ridge leans to +x and hides what lies to its right.
  EXPECT_EQ(sights[size_t(sheet.TexelAt(texels, 1.9, 0))].sight, 0);
  EXPECT_GT(sights[size_t(sheet.TexelAt(texels, -3, 0))].sight, 0.9F);
  EXPECT_GT(sights[size_t(sheet.TexelAt(texels, 5, 0))].sight, 0.9F);
}

TEST(FindTexelSights, RefusesAMeshOfFewerVertices) {
  const Sheet sheet = Sheet::Make(4, 6);
  testing::ExpectError(
      [&] { FindTexelSights(sheet.space, sheet.space.Rasterise(kProjectedSize), sheet.vertices.topRows(5), {}); },
      "5 vertices");
}

TEST(SampleLayer, ReadsThePictureAtTheTexelsPlaces) {
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(kProjectedSize);
  const auto sights = FindTexelSights(sheet.space, texels, sheet.vertices, {});
  const TexelColours colours = SampleLayer(Ramps(), sights);
  const auto texel = size_t(sheet.TexelAt(texels, 2, -3));
  EXPECT_NEAR(colours.colours[texel].x(), sights[texel].place.x() / 224, 1e-4);
  EXPECT_NEAR(colours.colours[texel].y(), sights[texel].place.y() / 224, 1e-4);
  EXPECT_EQ(colours.weights[texel], 1);
  EXPECT_EQ(colours.weights[0], 0);
}

TEST(SampleLayer, AveragesOverTheAreaOfATexel) {
  // Stripes of one pixel, which an atlas of 16 texels cannot show: it has their mean.
  PictureLayer stripes = Ramps();
  for (size_t i = 0; i < stripes.colours.size() / 3; ++i)
    for (size_t k = 0; k < 3; ++k) stripes.colours[3 * i + k] = float(i % 2);
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(16);
  const auto sights = FindTexelSights(sheet.space, texels, sheet.vertices, {});
  EXPECT_NEAR(sights[size_t(sheet.TexelAt(texels, 0, 0))].level, std::log2(121.8 / (0.8 * 16)), 1e-3);
  const TexelColours colours = SampleLayer(stripes, sights);
  EXPECT_NEAR(colours.colours[size_t(sheet.TexelAt(texels, 1, 1))].x(), 0.5, 1e-5);
}

TEST(SampleLayer, KnowsNothingOutsideOfThePictureAndOfTheLayer) {
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(kProjectedSize);
  PictureCamera camera;
  camera.shift << 112, 0;  // The right half of the sheet is outside.
  const auto sights = FindTexelSights(sheet.space, texels, sheet.vertices, camera);
  PictureLayer layer = Ramps();
  std::fill_n(layer.confidence.begin(), 112 * 224, 0.0F);  // The upper half is of another class.
  const TexelColours colours = SampleLayer(layer, sights);
  EXPECT_EQ(colours.weights[size_t(sheet.TexelAt(texels, 3, -3))], 0);
  EXPECT_EQ(colours.weights[size_t(sheet.TexelAt(texels, -3, 3))], 0);
  EXPECT_EQ(colours.weights[size_t(sheet.TexelAt(texels, -3, -3))], 1);
}

}  // namespace
}  // namespace daumier::fitting
