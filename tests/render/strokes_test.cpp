#include "render/strokes.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

Stroke Line(std::vector<std::array<float, 2>> points) {
  return {.kind = 0, .points = std::move(points)};
}

std::vector<int> Column(const Image& image, int column) {
  std::vector<int> values;
  for (int row = 0; row < image.height; ++row) values.push_back(image.at(row, column));
  return values;
}

/// Deterministic wiggles all over the canvas, some of them leaving it.
std::vector<Stroke> Wiggles(int num_strokes, int num_points) {
  std::vector<Stroke> strokes(num_strokes);
  for (int s = 0; s < num_strokes; ++s) {
    for (int p = 0; p < num_points; ++p) {
      strokes[s].points.push_back({static_cast<float>(128 + 150 * std::sin(0.37 * s + 0.11 * p)),
                                   static_cast<float>(128 + 120 * std::cos(1.3 * s + 0.07 * p))});
    }
  }
  return strokes;
}

TEST(RasteriseStrokes, HorizontalLineHasTheCoverageWorkedOutByHand) {
  // Through the centres of row 100 with half-width 1: the rows next to it are at d = 1, so half covered.
  const Image image = RasteriseStrokes({Line({{50, 100.5f}, {200, 100.5f}})}, 256, {.width = 2.0});
  EXPECT_EQ(image.at(100, 120), 0);
  EXPECT_EQ(image.at(99, 120), 128);
  EXPECT_EQ(image.at(101, 120), 128);
  EXPECT_EQ(image.at(98, 120), 255);
  EXPECT_EQ(image.at(102, 120), 255);
}

TEST(RasteriseStrokes, LineBetweenTwoRowsOfPixelsDarkensBothAlike) {
  // d = 1/2 for both rows, h = 0.75: coverage 0.75, 255 * 0.25 = 63.75.
  const Image image = RasteriseStrokes({Line({{50, 100}, {200, 100}})}, 256);
  EXPECT_EQ(image.at(99, 120), 64);
  EXPECT_EQ(image.at(100, 120), 64);
  EXPECT_EQ(image.at(98, 120), 255);
}

TEST(RasteriseStrokes, IsScaledFromTheCanvas) {
  // Canvas y = 101 is y = 50.5 at half size, the centre of row 50; h = 0.5 there, so coverage 1 on it and 0 next to it.
  const Image image = RasteriseStrokes({Line({{50, 101}, {200, 101}})}, 128, {.width = 2.0});
  EXPECT_EQ(image.height, 128);
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.at(50, 60), 0);
  EXPECT_EQ(image.at(49, 60), 255);
  EXPECT_EQ(image.at(51, 60), 255);
  EXPECT_EQ(image.at(50, 23), 255) << "left of the round end";
  EXPECT_EQ(image.at(50, 25), 0);
}

TEST(RasteriseStrokes, OnePointIsADot) {
  const Image image = RasteriseStrokes({Line({{10.5f, 20.5f}})}, 256, {.width = 2.0});
  EXPECT_EQ(image.at(20, 10), 0);
  EXPECT_EQ(image.at(20, 11), 128);
  EXPECT_EQ(image.at(21, 10), 128);
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), 255), 256 * 256 - 9);
}

TEST(RasteriseStrokes, WithoutAntialiasingIsBlackAndWhite) {
  const Image image = RasteriseStrokes(Wiggles(5, 60), 256, {.width = 1.5, .antialias = false});
  for (const uint8_t value : image.pixels) EXPECT_TRUE(value == 0 || value == 255);
  const Image line = RasteriseStrokes({Line({{50, 100.5f}, {200, 100.5f}})}, 256, {.width = 2.0, .antialias = false});
  EXPECT_EQ(line.at(99, 120), 0) << "d = h counts as covered";
  EXPECT_EQ(line.at(98, 120), 255);
}

TEST(RasteriseStrokes, MirroredStrokesGiveTheMirroredPicture) {
  auto strokes = Wiggles(6, 50);
  const Image image = RasteriseStrokes(strokes, 128);
  for (auto& stroke : strokes) {
    for (auto& point : stroke.points) point[0] = 256.0f - point[0];
  }
  const Image mirrored = RasteriseStrokes(strokes, 128);
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      ASSERT_NEAR(image.at(row, column), mirrored.at(row, 127 - column), 1) << row << " " << column;
    }
  }
}

TEST(RasteriseStrokes, DoesNotDependOnOrderOrDirection) {
  auto strokes = Wiggles(6, 50);
  const Image image = RasteriseStrokes(strokes, 128);
  std::reverse(strokes.begin(), strokes.end());
  EXPECT_EQ(RasteriseStrokes(strokes, 128), image);
  for (auto& stroke : strokes) std::reverse(stroke.points.begin(), stroke.points.end());
  const Image reversed = RasteriseStrokes(strokes, 128);
  for (size_t i = 0; i < image.pixels.size(); ++i) ASSERT_NEAR(image.pixels[i], reversed.pixels[i], 1);
}

TEST(RasteriseStrokes, JointsDoNotShow) {
  const Image whole = RasteriseStrokes({Line({{20, 77.3f}, {220, 77.3f}})}, 256);
  const Image parts = RasteriseStrokes({Line({{20, 77.3f}, {100, 77.3f}, {101, 77.3f}, {220, 77.3f}})}, 256);
  EXPECT_EQ(whole, parts);
  EXPECT_EQ(Column(whole, 60), Column(whole, 100));
}

TEST(RasteriseStrokes, CutsOffWhatLiesOutside) {
  const Image far = RasteriseStrokes({Line({{-500, -300}, {-20, 900}}), Line({{1e30f, 1e30f}, {1e30f, 2e30f}})}, 256);
  EXPECT_EQ(far, Image(256, 256, 1, 255));
  // A line that enters and leaves is drawn as the part inside would be.
  const Image through = RasteriseStrokes({Line({{-1000, 30.5f}, {1000, 30.5f}})}, 256);
  const Image inside = RasteriseStrokes({Line({{-5, 30.5f}, {261, 30.5f}})}, 256);
  EXPECT_EQ(through, inside);
}

TEST(RasteriseStrokes, AgreesWithTheDistanceToEverySegment) {
  const auto strokes = Wiggles(4, 30);
  const int size = 64;
  const Image image = RasteriseStrokes(strokes, size, {.width = 6.0});
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      double nearest = 1e9;
      for (const auto& stroke : strokes) {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
          const double ax = stroke.points[i - 1][0] / 4.0, ay = stroke.points[i - 1][1] / 4.0;
          const double bx = stroke.points[i][0] / 4.0, by = stroke.points[i][1] / 4.0;
          const double px = column + 0.5, py = row + 0.5;
          const double t = std::clamp(
              ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / (std::pow(bx - ax, 2) + std::pow(by - ay, 2)), 0.0,
              1.0);
          nearest = std::min(nearest, std::hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay)));
        }
      }
      ASSERT_NEAR(image.at(row, column), 255.0 * (1.0 - std::clamp(0.75 + 0.5 - nearest, 0.0, 1.0)), 0.51);
    }
  }
}

TEST(RasteriseStrokes, RefusesBadInput) {
  EXPECT_THROW(RasteriseStrokes({}, 0), Error);
  EXPECT_THROW(RasteriseStrokes({}, 64, {.width = 0.0}), Error);
  EXPECT_THROW(RasteriseStrokes({Line({{0, 0}, {std::numeric_limits<float>::quiet_NaN(), 1}})}, 64), Error);
  EXPECT_EQ(RasteriseStrokes({Line({})}, 64), Image(64, 64, 1, 255));
}

}  // namespace
}  // namespace daumier::render
