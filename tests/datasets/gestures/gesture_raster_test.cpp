#include "datasets/gestures/gesture_raster.h"

#include "datasets/gestures/path_pen.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace daumier::datasets {
namespace {

std::vector<float> RasterOf(const Polyline& stroke, const GestureRaster& raster = {}) {
  std::vector<float> picture(size_t(raster.side) * size_t(raster.side));
  RasteriseGesture(stroke, raster, picture);
  return picture;
}

TEST(GestureRaster, ALevelLineLiesInTheMiddleWithMargins) {
  const std::vector<float> picture = RasterOf({{100, 7}, {300, 7}}, {.side = 50, .width = 2, .binary = true});
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 50; ++column) {
      const bool is_ink = (row == 24 || row == 25) && column >= 3 && column < 47;
      const bool is_round_end = column == 2 || column == 47;
      if (!is_round_end) EXPECT_EQ(picture[size_t(50 * row + column)], is_ink ? 1 : 0) << row << " " << column;
    }
}

TEST(GestureRaster, PlaceSizeAndDirectionDoNotMatter) {
  const Polyline line = PathPen().Forward(1).Arc(3, 0.3).points();
  Polyline moved;
  for (const auto& point : Reversed(line)) moved.push_back(64 * point + Eigen::Vector2d(1024, -512));
  const std::vector<float> a = RasterOf(line), b = RasterOf(moved);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.01);
}

TEST(GestureRaster, ABinaryPictureHasTwoValues) {
  const Polyline ring = PathPen().Arc(6, 1).points();
  for (const float value : RasterOf(ring, {.side = 64, .width = 2, .binary = true}))
    EXPECT_TRUE(value == 0 || value == 1);
  const std::vector<float> grey = RasterOf(ring);
  EXPECT_TRUE(std::any_of(grey.begin(), grey.end(), [](float value) { return value > 0.2f && value < 0.8f; }));
}

TEST(GestureRaster, RefusesBadStrokesWithTheCause) {
  using testing::ExpectError;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ExpectError([] { RasterOf({}); }, "a gesture of 0 points");
  ExpectError([] { RasterOf({{1, 2}}); }, "a gesture of 1 points (expected a stroke of at least 2)");
  ExpectError([] { RasterOf({{1, 2}, {1, 2}, {1, 2}}); }, "all 3 points of a gesture are the same");
  ExpectError([&] { RasterOf({{1, 2}, {kNan, 2}}); }, "point 1 of a gesture");
  ExpectError([] { RasterOf({{0, 0}, {1e308, 0}, {-1e308, 0}}); }, "extent");
  ExpectError(
      [] {
        std::vector<float> small(9);
        RasteriseGesture({{0, 0}, {1, 1}}, {}, small);
      },
      "a picture of 9 pixels, expected 64 x 64");
}

}  // namespace
}  // namespace daumier::datasets
