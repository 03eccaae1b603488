#include "render/draw.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::render {
namespace {

/// Smallest and largest column with a dark pixel, and the same for rows.
struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Extent InkOf(const Image& image) {
  Extent extent;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      if (image.at(row, column) > 200) continue;
      extent = {std::min(extent.left, column), std::max(extent.right, column), std::min(extent.top, row),
                std::max(extent.bottom, row)};
    }
  }
  return extent;
}

TEST(DrawText, FillsItsLineAndItsWidth) {
  Image image(40, 200, 3);
  const TextStyle style{.height = 20};
  DrawText(image, "Hxgp 2.31", 10, 8, style);
  const Extent ink = InkOf(image);
  EXPECT_NEAR(ink.left, 10, 3);
  EXPECT_NEAR(ink.right, 10 + TextWidth("Hxgp 2.31", style), 8);
  EXPECT_GE(ink.top, 8);
  EXPECT_LE(ink.bottom, 8 + 20);
  EXPECT_GE(ink.bottom - ink.top, 10);
}

TEST(DrawText, AlignsAtCentreAndRight) {
  for (const auto& [align, x] : {std::pair{TextAlign::kCentre, 100.0}, std::pair{TextAlign::kRight, 150.0}}) {
    Image image(30, 200, 1);
    DrawText(image, "HHHHHH", x, 5, {.height = 18, .align = align});
    const Extent ink = InkOf(image);
    if (align == TextAlign::kCentre) {
      EXPECT_NEAR(0.5 * (ink.left + ink.right), 100, 2);
    } else {
      EXPECT_NEAR(ink.right, 150, 3);
    }
  }
}

TEST(DrawText, IsCutAtTheBorder) {
  for (const auto& [x, top] :
       {std::pair{-20.0, -8.0}, std::pair{25.0, 25.0}, std::pair{500.0, 500.0}, std::pair{-900.0, 3.0}}) {
    Image image(30, 30, 3);
    EXPECT_NO_THROW(DrawText(image, "long text that leaves", x, top));
  }
}

TEST(DrawText, OtherThanAsciiIsAQuestionMark) {
  Image image(30, 60, 1), expected(30, 60, 1);
  DrawText(image, "a\u00e9\u4e2db", 5, 5);
  DrawText(expected, "a??b", 5, 5);
  EXPECT_EQ(image, expected);
}

TEST(FittedTextStyle, FitsTheWidthAndLeavesShortTextAlone) {
  EXPECT_EQ(FittedTextStyle("ab", {}, 500).height, TextStyle{}.height);
  const TextStyle fitted = FittedTextStyle("a rather long caption", {}, 60);
  EXPECT_LE(TextWidth("a rather long caption", fitted), 62);
}

TEST(FillRectangle, CoversItsPixelsOnly) {
  Image image(4, 5, 3, 9);
  FillRectangle(image, 1, -2, 2, 4, {1, 2, 3});
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      EXPECT_EQ(image.at(row, column, 2), (row == 1 || row == 2) && column < 2 ? 3 : 9);
    }
  }
}

TEST(Paste, CopiesWithACutAndWidensGrey) {
  Image source(2, 2, 1);
  source.pixels = {1, 2, 3, 4};
  Image image(3, 3, 3, 0);
  Paste(image, source, -1, 2);
  EXPECT_EQ(image.at(0, 2, 0), 3);
  EXPECT_EQ(image.at(0, 2, 2), 3);
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), 0), 24);
  Image grey(2, 2, 1);
  EXPECT_THROW(Paste(grey, image, 0, 0), Error);
}

TEST(Resize, MakesSmallerByTheMeanOverTheArea) {
  Image image(2, 4, 1);
  image.pixels = {0, 10, 100, 200, 20, 30, 100, 200};
  EXPECT_EQ(Resize(image, 1, 2).pixels, (std::vector<uint8_t>{15, 150}));
  EXPECT_EQ(Resize(image, 2, 4), image);
}

TEST(Resize, MakesLargerAndRefusesNothing) {
  const Image flat(3, 3, 3, 40);
  EXPECT_EQ(Resize(flat, 7, 8), Image(7, 8, 3, 40));
  EXPECT_THROW(Resize(flat, 0, 8), Error);
  EXPECT_THROW(Resize(Image(), 2, 2), Error);
}

TEST(ToRgb, RepeatsGrey) {
  Image grey(1, 2, 1);
  grey.pixels = {5, 6};
  EXPECT_EQ(ToRgb(grey).pixels, (std::vector<uint8_t>{5, 5, 5, 6, 6, 6}));
}

}  // namespace
}  // namespace daumier::render
