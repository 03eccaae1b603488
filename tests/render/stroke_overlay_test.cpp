#include "render/stroke_overlay.h"

#include "tests/render/pixels.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(DrawnWithCurves, ShowsStrokesBlackAndCurvesRedAboveThem) {
  const Stroke across{0, {{0, 128}, {256, 128}}}, down{0, {{128, 0}, {128, 256}}};
  const Image picture = DrawnWithCurves({across}, {down}, 512);
  EXPECT_EQ(Pixel(picture, 100, 100), (Rgb{255, 255, 255}));
  EXPECT_EQ(Pixel(picture, 256, 100), (Rgb{0, 0, 0}));
  EXPECT_EQ(Pixel(picture, 100, 256), (Rgb{220, 50, 47}));
  EXPECT_EQ(Pixel(picture, 256, 256), (Rgb{220, 50, 47}));
}

}  // namespace
}  // namespace daumier::render
