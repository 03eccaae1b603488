#include "render/paper.h"

#include "core/error.h"
#include "render/strokes.h"
#include "tests/render/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// Two lines and a large black area, 256 x 256.
Image Lines() {
  Image image = RasteriseStrokes({{0, {{20, 40}, {230, 60}}}, {0, {{50, 220}, {120, 90}}}}, 256, {.width = 3.0});
  for (int row = 110; row < 210; ++row) {
    for (int column = 140; column < 230; ++column) image.at(row, column) = 0;
  }
  return image;
}

/// light(row, column) times the brightness of the picture, in [0, 255].
template <class Light>
Image Lit(const Image& image, Light light) {
  Image lit = image;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      lit.at(row, column) = static_cast<uint8_t>(image.at(row, column) * light(row, column) + 0.5);
    }
  }
  return lit;
}

TEST(NormaliseBackground, WhitePaperBecomes255AndBlackStaysBlack) {
  const Image flat = NormaliseBackground(Lines());
  EXPECT_EQ(flat.channels, 1);
  EXPECT_EQ(flat.at(5, 5), 255);
  EXPECT_EQ(flat.at(240, 128), 255);
  EXPECT_EQ(flat.at(160, 185), 0) << "inside of the large area";
}

TEST(NormaliseBackground, DoesNotDependOnTheLight) {
  const Image expected = NormaliseBackground(Lines());
  const auto grey = [](int, int) { return 0.6; };
  EXPECT_LE(LargestDifference(NormaliseBackground(Lit(Lines(), grey)), expected), 3);
  const auto gradient = [](int row, int column) { return 0.95 - 0.4 * row / 256.0 - 0.15 * column / 256.0; };
  EXPECT_LE(LargestDifference(NormaliseBackground(Lit(Lines(), gradient)), expected), 12);
  const auto vignette = [](int row, int column) {
    return 0.95 - 0.5 * (std::pow(row / 128.0 - 1, 2) + std::pow(column / 128.0 - 1, 2)) / 2;
  };
  EXPECT_LE(LargestDifference(NormaliseBackground(Lit(Lines(), vignette)), expected), 12);
}

TEST(NormaliseBackground, ShadowWithAHardEdgeIsPaper) {
  const auto shadow = [](int row, int column) { return 3 * row + column > 500 ? 0.75 : 0.95; };
  const Image lines = Lines(), flat = NormaliseBackground(Lit(lines, shadow));
  for (int row = 2; row < 254; ++row) {
    for (int column = 2; column < 254; ++column) {
      const bool is_paper = lines.at(row - 2, column) == 255 && lines.at(row + 2, column) == 255 &&
                            lines.at(row, column - 2) == 255 && lines.at(row, column + 2) == 255;
      if (is_paper) {
        ASSERT_GE(flat.at(row, column), 200) << row << " " << column;
      }
    }
  }
}

/// Six lines on white; nothing of them is wide.
Image LinesAlone() {
  std::vector<Stroke> strokes;
  for (int i = 0; i < 6; ++i) strokes.push_back({0, {{20, 30.0F + 35 * i}, {230, 40.0F + 35 * i}}});
  return RasteriseStrokes(strokes, 256, {.width = 3.0});
}

void ExpectOnlyLines(const Image& flat) {
  const Image lines = LinesAlone();
  for (int row = 3; row < 253; ++row) {
    for (int column = 3; column < 253; ++column) {
      const int value = flat.at(row, column);
      if (lines.at(row, column) == 0) {
        ASSERT_LE(value, 120) << row << " " << column;
      }
      const bool is_paper = lines.at(row - 3, column) == 255 && lines.at(row + 3, column) == 255;
      if (is_paper && lines.at(row, column) == 255) {
        ASSERT_GE(value, 190) << row << " " << column;
      }
    }
  }
}

TEST(NormaliseBackground, DarkShadowWithAHardEdgeIsPaper) {
  const auto shadow = [](int row, int column) { return 3 * column + row > 470 ? 0.42 : 0.95; };
  ExpectOnlyLines(NormaliseBackground(Lit(LinesAlone(), shadow)));
}

TEST(NormaliseBackground, SoftShadingIsPaper) {
  const auto smudge = [](int row, int column) {
    return 0.95 - 0.5 * std::exp(-std::pow(std::hypot(row - 128.0, column - 110.0) / 50.0, 3.0));
  };
  ExpectOnlyLines(NormaliseBackground(Lit(LinesAlone(), smudge)));
}

TEST(NormaliseBackground, LightLinesOnDarkAreInverted) {
  Image inverted = Lines();
  for (uint8_t& value : inverted.pixels) value = static_cast<uint8_t>(255 - value);
  EXPECT_LE(LargestDifference(NormaliseBackground(inverted), NormaliseBackground(Lines())), 2);
}

TEST(NormaliseBackground, ReadsColourByItsLuma) {
  Image colour(40, 60, 3, 200);
  for (int column = 10; column < 50; ++column) {
    colour.at(20, column, 0) = colour.at(20, column, 2) = 0;
  }
  const Image flat = NormaliseBackground(colour);
  EXPECT_EQ(flat.channels, 1);
  EXPECT_EQ(flat.at(5, 5), 255);
  EXPECT_LT(flat.at(20, 30), 215);
}

TEST(NormaliseBackground, AnySizeDownToOnePixel) {
  for (const auto& [height, width] : {std::pair{1, 1}, {1, 300}, {300, 2}, {7, 5}}) {
    const Image flat = NormaliseBackground(Image(height, width, 1, 90));
    EXPECT_EQ(flat.height, height);
    EXPECT_EQ(flat.width, width);
    for (const uint8_t value : flat.pixels) EXPECT_GE(value, 250);
  }
  EXPECT_THROW(NormaliseBackground(Image()), Error);
}

}  // namespace
}  // namespace daumier::render
