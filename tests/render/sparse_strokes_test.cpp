#include "render/sparse_strokes.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace daumier::render {
namespace {

size_t PointsIn(const std::vector<Stroke>& strokes) {
  size_t count = 0;
  for (const Stroke& stroke : strokes) count += stroke.points.size();
  return count;
}

/// A circle of the canvas drawn again and again by a hand that trembles.
std::vector<Stroke> Retraced(int times, double scale) {
  Rng rng(9);
  std::vector<Stroke> strokes;
  for (int i = 0; i < times; ++i) {
    Stroke& stroke = strokes.emplace_back();
    for (int k = 0; k <= 60; ++k) {
      const double angle = k * std::numbers::pi / 30, radius = 80 + 0.5 * rng.Normal();
      stroke.points.push_back(
          {float((128 + radius * std::cos(angle)) / scale), float((128 + radius * std::sin(angle)) / scale)});
    }
  }
  return strokes;
}

/// Share of the canvas's pixels that differ by more than half of black.
double ShareThatDiffers(const std::vector<Stroke>& a, const std::vector<Stroke>& b) {
  const Image x = RasteriseStrokes(a, 256), y = RasteriseStrokes(b, 256);
  int count = 0;
  for (size_t i = 0; i < x.pixels.size(); ++i) count += std::abs(int(x.pixels[i]) - int(y.pixels[i])) > 127;
  return double(count) / double(x.pixels.size());
}

TEST(SparseStrokes, AUsualDrawingIsUnchanged) {
  const std::vector<Stroke> strokes = Retraced(20, 1);
  const auto sparse = SparseStrokes(strokes, 1);
  ASSERT_EQ(sparse.size(), strokes.size());
  for (size_t i = 0; i < sparse.size(); ++i) EXPECT_EQ(sparse[i].points, strokes[i].points);
}

TEST(SparseStrokes, WhatIsDrawnAgainAndAgainIsDrawnAFewTimes) {
  for (const double scale : {1.0, 0.01}) {
    const std::vector<Stroke> strokes = Retraced(3000, scale);
    const auto sparse = SparseStrokes(strokes, scale);
    EXPECT_LT(PointsIn(sparse), PointsIn(strokes) / 15);
    EXPECT_LT(scale == 1.0 ? ShareThatDiffers(strokes, sparse) : 0.0, 0.002);
  }
}

TEST(SparseStrokes, OneStrokeOfManyPointsKeepsItsWay) {
  Stroke spiral;
  for (int i = 0; i < 200000; ++i) {
    const double angle = i * 1e-4 * std::numbers::pi, radius = 1 + 100 * i / 200000.0;
    spiral.points.push_back({float(128 + radius * std::cos(angle)), float(128 + radius * std::sin(angle))});
  }
  const auto sparse = SparseStrokes({spiral}, 1);
  ASSERT_EQ(sparse.size(), 1U);
  EXPECT_LT(sparse[0].points.size(), 6000U);
  EXPECT_EQ(sparse[0].points.front(), spiral.points.front());
  EXPECT_EQ(sparse[0].points.back(), spiral.points.back());
  EXPECT_LT(ShareThatDiffers({spiral}, sparse), 0.001);
}

TEST(SparseStrokes, LinesThatCrossAreBothKept) {
  std::vector<Stroke> strokes;
  for (int i = 0; i < 6000; ++i) {
    strokes.push_back({1, {{20, 128}, {236, 128}}});
    strokes.push_back({2, {{128, 20}, {128, 236}}});
    strokes.push_back({3, {{40, 40}}});
  }
  const auto sparse = SparseStrokes(strokes, 1);
  ASSERT_EQ(sparse.size(), 3U);
  EXPECT_EQ(sparse[0].kind, 1);
  EXPECT_EQ(sparse[1].kind, 2);
  EXPECT_EQ(sparse[2].points, strokes[2].points);
  EXPECT_EQ(ShareThatDiffers(strokes, sparse), 0);
}

TEST(SparseStrokes, BlackScribblesAreBounded) {
  Rng rng(4);
  Stroke scribble;
  for (int i = 0; i < 60000; ++i) scribble.points.push_back({float(rng.Uniform(30, 220)), float(rng.Uniform(30, 220))});
  EXPECT_LT(PointsIn(SparseStrokes({scribble}, 1)), 60000U);
}

TEST(SparseStrokes, RefusesImpossibleNumbers) {
  testing::ExpectError([] { SparseStrokes({}, 0); }, "expected a positive number");
  testing::ExpectError(
      [] {
        SparseStrokes({{0, {{std::numeric_limits<float>::quiet_NaN(), 0}}}}, 1);
      },
      "a point of the drawing is");
}

}  // namespace
}  // namespace daumier::render
