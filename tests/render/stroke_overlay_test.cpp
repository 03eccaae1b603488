#include "render/stroke_overlay.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

std::array<int, 3> Pixel(const Image& image, int row, int column) {
  const size_t first = 3 * (size_t(row) * size_t(image.width) + size_t(column));
  return {image.pixels[first], image.pixels[first + 1], image.pixels[first + 2]};
}

TEST(DrawnWithCurves, ShowsStrokesBlackAndCurvesRedAboveThem) {
  const Stroke across{0, {{0, 128}, {256, 128}}}, down{0, {{128, 0}, {128, 256}}};
  const Image picture = DrawnWithCurves({across}, {down}, 512);
  EXPECT_EQ(Pixel(picture, 100, 100), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(Pixel(picture, 256, 100), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(Pixel(picture, 100, 256), (std::array<int, 3>{220, 50, 47}));
  EXPECT_EQ(Pixel(picture, 256, 256), (std::array<int, 3>{220, 50, 47}));
}

}  // namespace
}  // namespace daumier::render
