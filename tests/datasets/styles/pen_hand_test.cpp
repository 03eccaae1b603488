#include "datasets/styles/pen_hand.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

Polyline ToPolyline(const StyledStroke& stroke) {
  Polyline line;
  for (const auto& p : stroke.points) line.emplace_back(p[0], p[1]);
  return line;
}

StyledLine LongLine() {
  StyledLine line{DrawnPart::kOutline, Resampled({{40, 60}, {120, 90}, {200, 60}}, 41), {}};
  line.labels.assign(21, faces::LineLabel::kUpperLip);
  line.labels.resize(41, faces::LineLabel::kLowerLip);
  return line;
}

TEST(DrawByHand, ASteadyHandDrawsTheLineItself) {
  Rng rng(1);
  const auto strokes = DrawByHand(LongLine(), {.width = 2}, rng);
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].width, 2);
  const Polyline drawn = ToPolyline(strokes[0]);
  for (const Eigen::Vector2d& point : LongLine().points) EXPECT_LT(DistanceTo(drawn, point), 1e-4);
  EXPECT_EQ(strokes[0].labels.size(), strokes[0].points.size());
}

TEST(DrawByHand, StrokesStayNearTheLineAndKeepItsLabels) {
  const HandHabits habits = {.width = 1.5,
                             .tremor = 1,
                             .bend = 1,
                             .doubled = 0.4,
                             .searching = 0.4,
                             .gaps = 0.5,
                             .overshoot = 3,
                             .polygon = 1};
  for (uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const StyledLine line = LongLine();
    for (const StyledStroke& stroke : DrawByHand(line, habits, rng)) {
      ASSERT_EQ(stroke.labels.size(), stroke.points.size());
      for (size_t i = 0; i < stroke.points.size(); ++i) {
        const Eigen::Vector2d point(stroke.points[i][0], stroke.points[i][1]);
        EXPECT_LT(DistanceTo(line.points, point), 3.5 + 2 * habits.polygon + 2 * 6 + 1);
        if (point.x() < 105) {
          EXPECT_EQ(stroke.labels[i], faces::LineLabel::kUpperLip);
        }
        if (point.x() > 135) {
          EXPECT_EQ(stroke.labels[i], faces::LineLabel::kLowerLip);
        }
      }
    }
  }
}

TEST(DrawByHand, HabitsChangeTheNumberOfStrokes) {
  Rng rng(1);
  EXPECT_EQ(DrawByHand(LongLine(), {.doubled = 1}, rng).size(), 2u);
  EXPECT_GE(DrawByHand(LongLine(), {.searching = 1}, rng).size(), 4u);
  EXPECT_EQ(DrawByHand(LongLine(), {.gaps = 1}, rng).size(), 2u);
  StyledLine mark = LongLine();
  mark.care = LineCare::kMark;
  EXPECT_EQ(DrawByHand(mark, {.doubled = 1, .searching = 1, .gaps = 1}, rng).size(), 1u);
  const auto polygon = DrawByHand(LongLine(), {.polygon = 1}, rng);
  ASSERT_EQ(polygon.size(), 1u);
  EXPECT_EQ(polygon[0].points.size(), 3u);
}

TEST(DrawByHand, WhatLeavesTheCanvasIsCut) {
  StyledLine line{DrawnPart::kBust,
                  {{-50, 100}, {100, 100}, {300, 120}, {100, 140}},
                  std::vector<faces::LineLabel>(4, faces::LineLabel::kNeck)};
  Rng rng(1);
  const auto strokes = DrawByHand(line, {}, rng);
  ASSERT_EQ(strokes.size(), 2u);
  for (const StyledStroke& stroke : strokes)
    for (const auto& p : stroke.points)
      for (const float x : p) EXPECT_TRUE(x >= 0 && x <= 256);
  line.points = {{-50, 100}, {-10, 100}};
  line.labels.resize(2);
  EXPECT_TRUE(DrawByHand(line, {}, rng).empty());
}

TEST(BendLines, AnchorsMoveWithTheirLines) {
  LineSheet sheet;
  sheet.lines.push_back(LongLine());
  const Polyline before = sheet.lines[0].points;
  Rng rng(1);
  BendLines(sheet, 1.5, rng);
  ASSERT_EQ(sheet.lines[0].points.size(), before.size());
  double largest = 0;
  for (size_t i = 0; i < before.size(); ++i) largest = std::max(largest, (sheet.lines[0].points[i] - before[i]).norm());
  EXPECT_GT(largest, 0.3);
  EXPECT_LE(largest, 3.5 + 1e-6);
}

TEST(DrawHabits, ASteadyHandHasAWidthAlone) {
  Rng rng(3);
  const HandHabits habits = DrawHabits({}, true, 1, rng);
  EXPECT_GT(habits.width, 0);
  EXPECT_EQ(
      habits.tremor + habits.bend + habits.doubled + habits.searching + habits.gaps + habits.overshoot + habits.polygon,
      0);
}

}  // namespace
}  // namespace daumier::datasets
