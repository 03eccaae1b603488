#include "render/soft_shading.h"

#include "core/error.h"
#include "render/draw.h"
#include "render/strokes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

/// A line across a disc of a darkness in [0, 1] whose border is a ramp of a width in pixels.
Image ShadedPicture(double darkness, double ramp) {
  Image image = RasteriseStrokes({{0, {{10, 128}, {246, 120}}}}, 400, {.width = 2.5});
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double distance = std::hypot(row - 200.0, column - 200.0);
      const double share = std::clamp((70.0 - distance) / ramp + 0.5, 0.0, 1.0);
      image.at(row, column) = static_cast<uint8_t>(std::lround(image.at(row, column) * (1.0 - darkness * share)));
    }
  }
  return image;
}

TEST(SoftShading, IsTheBrightnessOfASmudgeUnderLines) {
  for (const double darkness : {0.3, 0.6, 0.8}) {
    const auto shading = SoftShading(ShadedPicture(darkness, 40.0));
    ASSERT_TRUE(shading) << darkness;
    EXPECT_NEAR(shading->at(160, 200), 255 * (1.0 - darkness), 3) << "inside";
    EXPECT_NEAR(shading->at(198, 200), 255 * (1.0 - darkness), 6) << "under the line";
    EXPECT_EQ(shading->at(30, 30), 255) << "outside";
  }
}

TEST(SoftShading, AreasWithAnEdgeAndLinesAreNone) {
  EXPECT_FALSE(SoftShading(ShadedPicture(0.6, 1.0)));
  EXPECT_FALSE(SoftShading(ShadedPicture(0.95, 3.0)));
  EXPECT_FALSE(SoftShading(ShadedPicture(0.0, 1.0)));
  EXPECT_FALSE(SoftShading(Image(300, 300, 1, 255)));
  EXPECT_FALSE(SoftShading(Image(1, 1, 1, 0)));
}

TEST(SoftShading, FaintSmudgesWithFewStepsOfGreyAreSoft) {
  for (const double darkness : {0.2, 0.24, 0.3}) {
    const auto shading = SoftShading(ShadedPicture(darkness, 14.0));
    ASSERT_TRUE(shading) << darkness;
    EXPECT_NEAR(shading->at(160, 200), 255 * (1.0 - darkness), 3) << darkness;
  }
  EXPECT_FALSE(SoftShading(ShadedPicture(0.24, 1.0))) << "a wash with an edge";
}

/// Thin lines, and next to one of them a horizontal band of a darkness in [0, 1] with a blurred profile.
Image PictureWithBand(double darkness, double blur) {
  Image image = RasteriseStrokes(
      {{0, {{30, 140}, {226, 140}}}, {0, {{30, 180}, {226, 200}}}, {0, {{30, 60}, {226, 30}}}}, 400, {.width = 2.0});
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double aside = std::max({0.0, 130.0 - column, column - 270.0});
      const double distance = std::hypot(row - 190.0, aside);
      image.at(row, column) = static_cast<uint8_t>(
          std::lround(image.at(row, column) * (1.0 - darkness * std::exp(-0.5 * distance * distance / blur / blur))));
    }
  }
  return image;
}

TEST(SoftShading, SmudgesHardlyWiderThanLinesAreSoft) {
  for (const double darkness : {0.3, 0.4}) {
    const Image picture = PictureWithBand(darkness, 6.0);
    const auto shading = SoftShading(picture);
    ASSERT_TRUE(shading) << darkness;
    EXPECT_NEAR(shading->at(190, 200), picture.at(190, 200), 4) << "the crest";
    EXPECT_EQ(shading->at(218, 60), 255) << "the line";
  }
  EXPECT_FALSE(SoftShading(PictureWithBand(0.95, 6.0))) << "as dark as the line: soft ink";
  EXPECT_FALSE(SoftShading(PictureWithBand(0.4, 1.0))) << "a grey line";
}

TEST(SoftShading, LinesCloseTogetherAreNone) {
  std::vector<Stroke> strokes;
  for (int i = 0; i < 9; ++i) strokes.push_back({0, {{100.0F + float(4 * i), 100}, {90.0F + float(5 * i), 150}}});
  for (int i = 0; i < 6; ++i) strokes.push_back({0, {{95, 105.0F + float(7 * i)}, {135, 100.0F + float(8 * i)}}});
  EXPECT_FALSE(SoftShading(RasteriseStrokes(strokes, 400, {.width = 1.5})));
}

TEST(SoftShading, RefusesColour) {
  EXPECT_THROW(SoftShading(Image(4, 4, 3)), Error);
}

}  // namespace
}  // namespace daumier::render
