#include "render/ink.h"

#include "core/random.h"
#include "render/draw.h"
#include "render/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

int64_t NumInk(const Image& mask) {
  return std::count(mask.pixels.begin(), mask.pixels.end(), kInk);
}

void Fill(Image& image, int top, int left, int height, int width, uint8_t value) {
  FillRectangle(image, top, left, height, width, {value, value, value});
}

Image White() {
  return {512, 512, 1, 255};
}

TEST(InkMask, BlackBarIsItself) {
  Image bar = White();
  Fill(bar, 200, 100, 5, 300, 0);
  EXPECT_EQ(InkMask(bar), bar);
}

TEST(InkMask, FaintLinesCountNextToBlackOnes) {
  Image image = White();
  Fill(image, 200, 100, 5, 300, 0);
  Fill(image, 300, 100, 5, 300, 150);
  EXPECT_EQ(NumInk(InkMask(image)), 2 * 5 * 300);
}

TEST(InkMask, FaintDrawingCountsAboveTheGrain) {
  Image image = White();
  Fill(image, 200, 100, 5, 300, 225);
  Rng rng(1);
  for (uint8_t& value : image.pixels) {
    value = static_cast<uint8_t>(std::clamp(value + 2.5 * rng.Normal() - 4.0, 0.0, 255.0));
  }
  EXPECT_NEAR(static_cast<double>(NumInk(InkMask(image))), 5 * 300, 60);
}

TEST(InkMask, EmptyPaperHoldsNoInk) {
  EXPECT_EQ(NumInk(InkMask(White())), 0);
  Image noise = White();
  Rng rng(2);
  for (uint8_t& value : noise.pixels) value = static_cast<uint8_t>(std::clamp(245 + 2.0 * rng.Normal(), 0.0, 255.0));
  EXPECT_EQ(NumInk(InkMask(noise)), 0);
}

TEST(InkMask, LinesSideBySideStayApart) {
  Image image = White();
  Fill(image, 200, 100, 4, 300, 0);
  Fill(image, 204, 100, 3, 300, 150);
  Fill(image, 207, 100, 4, 300, 0);
  EXPECT_EQ(InkMask(image).at(205, 250), kPaper);
}

TEST(InkMask, SpecksArePaperAndPinholesAreInk) {
  Image image = White();
  Fill(image, 200, 100, 5, 300, 0);
  Image expected = image;
  Fill(image, 400, 400, 2, 2, 0);
  Fill(image, 202, 300, 1, 2, 255);
  EXPECT_EQ(InkMask(image), expected);
}

TEST(InkMask, SmallPiecesFainterThanTheLinesArePaper) {
  Image image = White();
  Fill(image, 200, 100, 5, 300, 60);
  Image expected = image;
  Fill(image, 300, 100, 5, 300, 190);
  Fill(image, 400, 100, 5, 20, 190);
  Fill(expected, 300, 100, 5, 300, 0);
  Fill(expected, 200, 100, 5, 300, 0);
  EXPECT_EQ(InkMask(image), expected);
}

TEST(InkMask, FrameAndScanBorderArePaper) {
  Image expected = White();
  Fill(expected, 200, 100, 5, 300, 0);
  Image frame = expected;
  for (int side = 0; side < 2; ++side) {
    Fill(frame, 10 + side * 488, 10, 4, 492, 0);
    Fill(frame, 10, 10 + side * 488, 492, 4, 0);
  }
  EXPECT_EQ(InkMask(frame), expected);
  Image scan = expected;
  Fill(scan, 0, 0, 512, 60, 0);
  Fill(scan, 500, 0, 12, 512, 20);
  EXPECT_EQ(InkMask(scan), expected);
}

TEST(InkMask, SlantedScanBorderIsPaper) {
  Image scan = White();
  Fill(scan, 200, 100, 5, 300, 0);
  for (int column = 0; column < 512; ++column) Fill(scan, 0, column, 10 + column / 30, 1, 0);
  EXPECT_EQ(NumInk(InkMask(scan)), 5 * 300);
}

TEST(InkMask, AreaCutByTheBorderStays) {
  Image image = White();
  Fill(image, 400, 250, 112, 200, 0);
  EXPECT_EQ(InkMask(image), image);
}

TEST(PenWidth, IsTheWidthOfMostLines) {
  Image image = White();
  EXPECT_EQ(PenWidth(image), 0.0);
  Fill(image, 100, 50, 5, 400, kInk);
  Fill(image, 200, 50, 5, 400, kInk);
  EXPECT_DOUBLE_EQ(PenWidth(image), 5.0);
  Fill(image, 300, 50, 150, 150, kInk);
  EXPECT_DOUBLE_EQ(PenWidth(image), 5.0);
}

TEST(HollowAreas, LinesStayAndAreasBecomeOutlines) {
  Image image = White();
  Fill(image, 100, 50, 5, 400, kInk);
  EXPECT_EQ(HollowAreas(image, 5.0), image);
  Fill(image, 250, 100, 100, 200, kInk);
  const Image hollow = HollowAreas(image, 5.0);
  EXPECT_EQ(hollow.at(102, 200), kInk);
  EXPECT_EQ(hollow.at(252, 200), kInk);
  EXPECT_EQ(hollow.at(300, 102), kInk);
  EXPECT_EQ(hollow.at(300, 200), kPaper);
  EXPECT_EQ(hollow.at(258, 200), kPaper);
  for (size_t i = 0; i < image.pixels.size(); ++i) EXPECT_GE(hollow.pixels[i], image.pixels[i]);
}

TEST(HollowAreas, NarrowGapBetweenAreasCloses) {
  Image image = White();
  Fill(image, 250, 100, 100, 100, kInk);
  Image near = image, far = image;
  Fill(near, 250, 203, 100, 100, kInk);
  Fill(far, 250, 212, 100, 100, kInk);
  EXPECT_EQ(HollowAreas(near, 5.0).at(300, 201), kPaper) << "the inside of one area";
  EXPECT_EQ(HollowAreas(near, 5.0).at(300, 197), kPaper);
  EXPECT_EQ(HollowAreas(far, 5.0).at(300, 197), kInk) << "an outline of its own";
}

TEST(HollowAreas, SmallHolesInAnAreaClose) {
  Image image = White();
  Fill(image, 200, 100, 200, 200, kInk);
  Fill(image, 290, 190, 20, 20, kPaper);
  Fill(image, 298, 190, 2, 20, kInk);
  const Image hollow = HollowAreas(image, 5.0);
  EXPECT_EQ(std::count(hollow.pixels.begin() + 230 * 512, hollow.pixels.begin() + 370 * 512, kInk), 140 * 2 * 5);
}

TEST(HollowAreas, HasNoOutlineWhereThePictureCutsAnArea) {
  Image image = White();
  Fill(image, 400, 100, 112, 200, kInk);
  const Image hollow = HollowAreas(image, 5.0);
  EXPECT_EQ(hollow.at(511, 200), kPaper);
  EXPECT_EQ(hollow.at(402, 200), kInk);
}

}  // namespace
}  // namespace daumier::render
