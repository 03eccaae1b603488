#include "render/framing.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace daumier::render {
namespace {

Stroke Circle(double cx, double cy, double rx, double ry) {
  Stroke stroke;
  for (int i = 0; i <= 100; ++i) {
    const double angle = 0.02 * std::numbers::pi * i;
    stroke.points.push_back(
        {static_cast<float>(cx + rx * std::cos(angle)), static_cast<float>(cy + ry * std::sin(angle))});
  }
  return stroke;
}

struct Box {
  float left = 1e9F, top = 1e9F, right = -1e9F, bottom = -1e9F;
};
Box BoxOf(const std::vector<Stroke>& strokes) {
  Box box;
  for (const auto& stroke : strokes) {
    for (const auto& [x, y] : stroke.points) {
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y)};
    }
  }
  return box;
}

TEST(FrameStrokes, TallDrawingGetsTheCurveHeight) {
  const Box box = BoxOf(FrameStrokes({900, 1200, {Circle(300, 700, 100, 150)}}));
  EXPECT_NEAR(box.bottom - box.top, 0.62 * 256, 0.1);
  EXPECT_NEAR(box.right - box.left, 0.62 * 256 * 2 / 3, 0.1);
  EXPECT_NEAR(box.left + box.right, 256, 0.1);
  EXPECT_NEAR(box.top + box.bottom, 256, 0.1);
}

TEST(FrameStrokes, WideDrawingGetsTheLargestWidth) {
  const Box box = BoxOf(FrameStrokes({900, 1200, {Circle(300, 700, 200, 50)}}));
  EXPECT_NEAR(box.right - box.left, 0.8 * 256, 0.1);
  EXPECT_NEAR(box.bottom - box.top, 0.2 * 256, 0.1);
}

TEST(FrameStrokes, IsASimilarityThatKeepsKinds) {
  const Drawing drawing{100, 100, {{2, {{10, 10}, {50, 40}, {30, 90}}}, {1, {{20, 30}, {60, 35}}}}};
  const auto framed = FrameStrokes(drawing);
  ASSERT_EQ(framed.size(), 2U);
  EXPECT_EQ(framed[0].kind, 2);
  EXPECT_EQ(framed[1].kind, 1);
  const double scale = 0.62 * 256 / 80;
  for (size_t s = 0; s < 2; ++s) {
    for (size_t i = 0; i < drawing.strokes[s].points.size(); ++i) {
      const auto [x, y] = drawing.strokes[s].points[i];
      EXPECT_NEAR(framed[s].points[i][0], 128 + scale * (x - 35), 1e-3);
      EXPECT_NEAR(framed[s].points[i][1], 128 + scale * (y - 50), 1e-3);
    }
  }
}

TEST(FrameStrokes, DoesNotDependOnScaleAndPlace) {
  const auto expected = FrameStrokes({100, 100, {Circle(40, 50, 20, 30), Circle(30, 45, 3, 4)}});
  const auto moved = FrameStrokes({9000, 9000, {Circle(4700, 1500, 2000, 3000), Circle(3700, 1000, 300, 400)}});
  for (size_t s = 0; s < 2; ++s) {
    for (size_t i = 0; i < expected[s].points.size(); ++i) {
      EXPECT_NEAR(expected[s].points[i][0], moved[s].points[i][0], 1e-2);
      EXPECT_NEAR(expected[s].points[i][1], moved[s].points[i][1], 1e-2);
    }
  }
}

TEST(FrameStrokes, StrokesFarOutsideAreLeftOut) {
  const Stroke face = Circle(500, 500, 100, 150);
  const auto alone = FrameStrokes({1000, 1000, {face}});
  const auto with_dirt = FrameStrokes({1000, 1000, {face, {0, {{10, 990}}}, {0, {{900, 20}, {912, 20}}}}});
  ASSERT_EQ(with_dirt.size(), 1U);
  EXPECT_EQ(with_dirt[0].points, alone[0].points);
}

TEST(FrameStrokes, WhatBelongsToTheDrawingCountsWhole) {
  // A long thin line that leaves the circle upwards.
  const Stroke line{0, {{500, 350}, {500, 250}}};
  const Box box = BoxOf(FrameStrokes({1000, 1000, {Circle(500, 500, 100, 150), line}}));
  EXPECT_NEAR(box.bottom - box.top, 0.62 * 256, 0.1);
  EXPECT_EQ(FrameStrokes({1000, 1000, {Circle(500, 500, 100, 150), line}}).size(), 2U);
}

TEST(FrameStrokes, OptionsAreUsed) {
  const FrameOptions options{.curve_height = 0.5, .max_width = 0.4};
  const Box tall = BoxOf(FrameStrokes({100, 100, {Circle(50, 50, 10, 40)}}, options));
  EXPECT_NEAR(tall.bottom - tall.top, 128, 0.1);
  const Box wide = BoxOf(FrameStrokes({100, 100, {Circle(50, 50, 40, 40)}}, options));
  EXPECT_NEAR(wide.right - wide.left, 0.4 * 256, 0.1);
}

TEST(FrameDrawing, ReturnsThePlacementOfTheStrokes) {
  const Stroke face = Circle(500, 500, 100, 150);
  const FramedDrawing framed = FrameDrawing({1000, 1000, {face, {0, {{10, 990}}}}});
  ASSERT_EQ(framed.strokes.size(), 1U);
  EXPECT_EQ(framed.strokes[0].points, face.points) << "as the sheet has them";
  EXPECT_NEAR(framed.box.sizes().y(), 300, 1e-3);
  EXPECT_NEAR(framed.placement.scale, 0.62 * 256 / 300, 1e-6);
  EXPECT_NEAR((framed.placement.scale * framed.box.center() + framed.placement.shift).x(), 128, 1e-6);
}

TEST(MapToCanvas, ScalesThenShifts) {
  const auto placed = MapToCanvas({{3, {{10, 20}, {-1, 0}}}}, {2, {5, -7}});
  EXPECT_EQ(placed[0].kind, 3);
  EXPECT_EQ(placed[0].points[0], (std::array<float, 2>{25, 33}));
  EXPECT_EQ(placed[0].points[1], (std::array<float, 2>{3, -7}));
}

TEST(MapToCanvas, TurnsClockwiseBeforeItShifts) {
  const auto placed = MapToCanvas({{0, {{10, 20}, {0, 0}}}}, {2, {5, -7}, 90});
  EXPECT_NEAR(placed[0].points[0][0], -35, 1e-5) << "x, to the right, becomes y, downwards";
  EXPECT_NEAR(placed[0].points[0][1], 13, 1e-5);
  EXPECT_EQ(placed[0].points[1], (std::array<float, 2>{5, -7}));
}

TEST(ToSheet, UndoesToCanvas) {
  const Placement placement{0.37, {31, -12}, 17};
  const Eigen::Vector2d point(412.5, 77.25);
  EXPECT_LT((ToSheet(placement, ToCanvas(placement, point)) - point).norm(), 1e-9);
  const auto placed = MapToCanvas({{0, {{412.5F, 77.25F}}}}, placement);
  EXPECT_NEAR(placed[0].points[0][0], ToCanvas(placement, point).x(), 1e-4);
  EXPECT_NEAR(placed[0].points[0][1], ToCanvas(placement, point).y(), 1e-4);
}

TEST(Placement, AnInverseUndoesAndACompositionFollows) {
  const Placement first{0.37, {31, -12}, 17}, second{2.5, {-4, 8}, -50};
  const Eigen::Vector2d point(412.5, 77.25);
  EXPECT_LT((ToCanvas(Inverse(first), ToCanvas(first, point)) - point).norm(), 1e-9);
  EXPECT_LT((ToCanvas(Composed(second, first), point) - ToCanvas(second, ToCanvas(first, point))).norm(), 1e-9);
}

TEST(Placement, IsThatOfItsLinearPart) {
  EXPECT_TRUE(LinearPart({2, {5, -7}, 90}).isApprox((Eigen::Matrix2d() << 0, -2, 2, 0).finished()));
  const Placement placement{0.37, {31, -12}, 17};
  const Eigen::Matrix2d linear = LinearPart(placement);
  const Placement again = PlacementFrom(linear(0, 0), linear(1, 0), placement.shift);
  EXPECT_NEAR(again.scale, placement.scale, 1e-12);
  EXPECT_NEAR(again.turn_degrees, placement.turn_degrees, 1e-12);
  EXPECT_EQ(again.shift, placement.shift);
}

TEST(PlacementToJson, IsUndoneAndLeavesOutNoTurn) {
  const Placement turned{0.37, {31, -12}, 17};
  const Placement read = PlacementFromJson(PlacementToJson(turned));
  EXPECT_EQ(read.scale, turned.scale);
  EXPECT_EQ(read.shift, turned.shift);
  EXPECT_EQ(read.turn_degrees, turned.turn_degrees);
  EXPECT_FALSE(PlacementToJson({2, {0, 0}}).contains("turn_degrees"));
  EXPECT_EQ(PlacementFromJson(Json::parse(R"({"scale": 2, "shift": [3, 4]})")).turn_degrees, 0);
}

TEST(PlacementToJson, MalformedFramesAreRefused) {
  testing::ExpectError([] { PlacementFromJson(Json::parse(R"({"scale": 2})")); }, "the frame is malformed");
  testing::ExpectError([] { PlacementFromJson(Json::parse(R"({"scale": 2, "shift": [1]})")); }, "expected 2");
  testing::ExpectError([] { PlacementFromJson(Json::parse(R"({"scale": "a", "shift": [1, 2]})")); }, "malformed");
  testing::ExpectError([] { PlacementFromJson(Json::parse(R"({"scale": 0, "shift": [1, 2]})")); }, "> 0");
}

TEST(HomographyToJson, IsUndoneAndMalformedOnesAreRefused) {
  Eigen::Matrix3d homography;
  homography << 2, 0.1, 30, -0.2, 1.5, 4, 1e-3, -2e-4, 1;
  EXPECT_EQ(HomographyFromJson(HomographyToJson(homography)), homography);
  testing::ExpectError([] { HomographyFromJson(Json::parse("[[1, 0, 0], [0, 1, 0]]")); }, "malformed");
  testing::ExpectError([] { HomographyFromJson(Json::parse("[[1, 0, 0], [0, 1, 0], [1, 1]]")); }, "malformed");
  testing::ExpectError([] { HomographyFromJson(Json::parse("[[1, 0, 0], [0, 1, 0], [1, 1, 0]]")); }, "singular");
}

TEST(FrameStrokes, DotsAndStraightLinesHaveAFrameToo) {
  const auto line = FrameStrokes({100, 100, {{0, {{20, 50}, {80, 50}}}}});
  EXPECT_NEAR(line[0].points[1][0] - line[0].points[0][0], 0.8 * 256, 0.1);
  EXPECT_EQ(FrameStrokes({100, 100, {{0, {{20, 50}}}, {0, {{30, 60}}}}}).size(), 2U);
}

TEST(FrameStrokes, RefusesWhatHasNoExtent) {
  EXPECT_THROW(FrameStrokes({10, 10, {}}), Error);
  EXPECT_THROW(FrameStrokes({10, 10, {{0, {}}}}), Error);
  EXPECT_THROW(FrameStrokes({10, 10, {{0, {{3, 3}}}}}), Error);
  EXPECT_THROW(FrameStrokes({10, 10, {{0, {{3, std::numeric_limits<float>::quiet_NaN()}, {4, 4}}}}}), Error);
}

}  // namespace
}  // namespace daumier::render
