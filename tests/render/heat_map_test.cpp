#include "render/heat_map.h"

#include "core/error.h"
#include "tests/render/pixels.h"
#include "tests/render/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace daumier::render {
namespace {

using testing::Square;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Sees all of Square() in 20 x 20 pixels.
Camera SquareCamera() {
  return FrontalCamera({0.0, 0.0, 0.0}, 1.0, 20);
}

double Lightness(const Rgb& colour) {
  return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
}

TEST(ColourOf, HasTheMapsEndsAtTheRangesEndsAndBeyond) {
  const ValueRange range{2.0, 4.0};
  const Rgb violet = {68, 1, 84}, yellow = {253, 231, 37};
  for (const double value : {2.0, 1.0, -kInfinity}) EXPECT_EQ(ColourOf(value, range), violet) << value;
  for (const double value : {4.0, 9.0, kInfinity}) {
    const Rgb colour = ColourOf(value, range);
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(colour[channel], yellow[channel], 2) << value;
  }
  EXPECT_NE(ColourOf(2.0, range, ColourMap::kTurbo), violet);
}

TEST(ColourOf, NanIsNeutralGrey) {
  for (const ColourMap map : {ColourMap::kViridis, ColourMap::kTurbo}) {
    const Rgb grey = ColourOf(kNan, {0.0, 1.0}, map);
    EXPECT_NEAR(grey[0], grey[1], 3);
    EXPECT_NEAR(grey[0], grey[2], 3);
  }
}

TEST(ColourOf, ViridisIsLighterForLargerValuesAndTurboIsNot) {
  bool turbo_falls = false;
  for (int i = 0; i < 50; ++i) {
    const double value = i / 50.0, next = (i + 1) / 50.0;
    EXPECT_LT(Lightness(ColourOf(value, {})), Lightness(ColourOf(next, {}))) << value;
    turbo_falls = turbo_falls || Lightness(ColourOf(value, {}, ColourMap::kTurbo)) >
                                     Lightness(ColourOf(next, {}, ColourMap::kTurbo)) + 1.0;
  }
  EXPECT_TRUE(turbo_falls);
}

TEST(ColourOf, InterpolatesBetweenTableEntries) {
  const Rgb low = ColourOf(100.0 / 255.0, {}), high = ColourOf(101.0 / 255.0, {}),
            between = ColourOf(100.5 / 255.0, {});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(between[k], 0.5 * (low[k] + high[k]), 0.51);
}

TEST(ColourOf, RefusesAnEmptyRange) {
  EXPECT_THROW(ColourOf(0.0, {1.0, 1.0}), Error);
  EXPECT_THROW(ColourOf(0.0, {2.0, 1.0}), Error);
  EXPECT_THROW(ColourOf(0.0, {0.0, kNan}), Error);
  EXPECT_THROW(ColourOf(kNan, {1.0, 1.0}), Error);
}

TEST(ColoursOf, GivesOneColourAValue) {
  const auto colours = ColoursOf(Eigen::Vector3d(0.0, 0.4, kNan), {0.0, 1.0});
  ASSERT_EQ(colours.size(), 3u);
  EXPECT_EQ(colours[0], ColourOf(0.0, {}));
  EXPECT_EQ(colours[1], ColourOf(0.4, {}));
  EXPECT_EQ(colours[2], ColourOf(kNan, {}));
}

TEST(RenderHeatMap, ASurfaceHasNearlyTheColourOfItsValue) {
  for (const double value : {0.0, 0.3, 1.0, kNan}) {
    const Image image = RenderHeatMap({Square()}, Eigen::Vector4d::Constant(value), {}, SquareCamera());
    const Rgb drawn = Pixel(image, 10, 9), expected = ColourOf(value, {});
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(drawn[channel], expected[channel], 16) << value;
  }
}

TEST(RenderHeatMap, ClosingTrianglesAreGrey) {
  RenderInput input{Square()};
  input.closing_triangles = input.surface.triangles.bottomRows(1);
  input.closing_colours = {Rgb{255, 0, 0}};
  input.surface.triangles.conservativeResize(1, 3);
  const Image image = RenderHeatMap(input, Eigen::Vector4d::Constant(1.0), {}, SquareCamera());
  const Rgb closed = Pixel(image, 4, 4), surface = Pixel(image, 15, 15);
  EXPECT_NEAR(closed[0], closed[1], 8);
  EXPECT_NEAR(closed[0], closed[2], 8);
  EXPECT_GT(surface[0], surface[2] + 100) << "yellow";
}

TEST(RenderHeatMap, RefusesOtherNumbersOfValuesAndAnEmptyRange) {
  EXPECT_THROW(RenderHeatMap({Square()}, Eigen::VectorXd::Zero(3), {}, SquareCamera()), Error);
  EXPECT_THROW(RenderHeatMap({Square()}, Eigen::VectorXd::Zero(4), {1.0, 0.0}, SquareCamera()), Error);
}

TEST(DrawColourBar, MakesItsStripWhiteAndLeavesTheRestAlone) {
  Image image(100, 120, 3, 7);
  DrawColourBar(image, {0.0, 2.0}, "mm");
  const int left = 120 - kColourBarWidth;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < left; ++column) ASSERT_EQ(image.at(row, column), 7) << row << " " << column;
    EXPECT_EQ(Pixel(image, row, left), kWhite);
    EXPECT_EQ(Pixel(image, row, 119), kWhite);
  }
}

TEST(DrawColourBar, GoesFromLowBelowToHighAboveWithLabelledTicks) {
  Image image(100, kColourBarWidth, 3, 0);
  DrawColourBar(image, {0.0, 2.0}, "");
  const int column = 17;  // Within the bar.
  int top = 0, bottom = 99;
  while (Pixel(image, top, column) == kWhite) ++top;
  while (Pixel(image, bottom, column) == kWhite) --bottom;
  const int height = bottom - top + 1;
  EXPECT_GT(height, 50);
  EXPECT_NEAR(Lightness(Pixel(image, top, column)), Lightness(ColourOf(2.0, {0.0, 2.0})), 4);
  EXPECT_NEAR(Lightness(Pixel(image, bottom, column)), Lightness(ColourOf(0.0, {0.0, 2.0})), 4);
  // Ticks at 0, 1 and 2 are right of the bar, with white between them.
  int right = column;
  while (Pixel(image, top + height / 4, right) != kWhite) ++right;
  std::vector<int> ticks;
  for (int row = 0; row < 100; ++row) {
    if (Lightness(Pixel(image, row, right + 1)) < 100) ticks.push_back(row);
  }
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_NEAR(ticks[0], top, 1);
  EXPECT_NEAR(ticks[1], top + height / 2, 1);
  EXPECT_NEAR(ticks[2], bottom, 1);
  const auto has_ink = [&](int first_row, int last_row) {
    for (int row = first_row; row <= last_row; ++row) {
      for (int x = right + 6; x < kColourBarWidth; ++x) {
        if (image.at(row, x) < 128) return true;
      }
    }
    return false;
  };
  for (const int tick : ticks) EXPECT_TRUE(has_ink(tick - 4, tick + 4)) << tick;
  EXPECT_FALSE(has_ink(top + height / 4 - 3, top + height / 4 + 3));
}

TEST(DrawColourBar, TheUnitIsAbove) {
  Image with_unit(100, kColourBarWidth, 3), without_unit = with_unit;
  DrawColourBar(with_unit, {0.0, 2.0}, "mm");
  DrawColourBar(without_unit, {0.0, 2.0}, "");
  int first = 100, last = -1;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < kColourBarWidth; ++column) {
      if (Pixel(with_unit, row, column) == Pixel(without_unit, row, column)) continue;
      first = std::min(first, row);
      last = row;
    }
  }
  EXPECT_GE(first, 4);
  EXPECT_LE(last, 20);
  EXPECT_LT(first, last);
}

TEST(DrawColourBar, RefusesImagesWithoutRoomAndEmptyRanges) {
  Image grey(100, 100, 1), narrow(100, kColourBarWidth - 1, 3), low(59, 100, 3), good(60, kColourBarWidth, 3);
  EXPECT_THROW(DrawColourBar(grey, {}, "mm"), Error);
  EXPECT_THROW(DrawColourBar(narrow, {}, "mm"), Error);
  EXPECT_THROW(DrawColourBar(low, {}, "mm"), Error);
  EXPECT_THROW(DrawColourBar(good, {1.0, 1.0}, "mm"), Error);
  EXPECT_NO_THROW(DrawColourBar(good, {}, "mm"));
}

}  // namespace
}  // namespace daumier::render
