#include "render/pen_areas.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using OutlinePoints = std::vector<Vector2d>;

OutlinePoints BarOutline(double left, double top, double right, double bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

OutlinePoints CircleOutline(const Vector2d& centre, double radius) {
  OutlinePoints points;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 64;
    points.push_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

PaintedArea AreaOf(std::vector<OutlinePoints> outlines, FillRule rule = FillRule::kNonzero) {
  return {.shape = {std::move(outlines), rule}, .paint = Paint::kInk, .kind = 0, .drawn_lines = {}};
}

std::vector<Stroke> StrokesOfOne(const PaintedArea& area) {
  return StrokesOfAreas({area}, 256.0)[0];
}

TEST(PenAreas, CutBarIsItsMiddleLineFromEndToEnd) {
  auto area = AreaOf({BarOutline(40, 98, 140, 102)});
  area.kind = 2;
  const auto strokes = StrokesOfOne(area);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].kind, 2);
  float left = 256, right = 0;
  for (const auto& [x, y] : strokes[0].points) {
    EXPECT_NEAR(y, 100, 0.4);
    left = std::min(left, x);
    right = std::max(right, x);
  }
  EXPECT_NEAR(left, 40, 0.5);
  EXPECT_NEAR(right, 140, 0.5);
}

TEST(PenAreas, RoundEndsAreHalfAWidthBeforeTheEdge) {
  const auto strokes =
      StrokesOfOne(AreaOf({BarOutline(40, 96, 140, 104), CircleOutline({40, 100}, 4), CircleOutline({140, 100}, 4)}));
  ASSERT_EQ(strokes.size(), 1U);
  const auto& points = strokes[0].points;
  EXPECT_NEAR(std::min(points.front()[0], points.back()[0]), 40, 0.8);
  EXPECT_NEAR(std::max(points.front()[0], points.back()[0]), 140, 0.8);
}

TEST(PenAreas, RingIsOneClosedLineByEitherRule) {
  const auto outer = CircleOutline({128, 128}, 52), inner = CircleOutline({128, 128}, 48);
  for (const auto& area :
       {AreaOf({outer, inner}, FillRule::kEvenOdd), AreaOf({outer, {inner.rbegin(), inner.rend()}})}) {
    const auto strokes = StrokesOfOne(area);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_EQ(strokes[0].points.front(), strokes[0].points.back());
    for (const auto& [x, y] : strokes[0].points) EXPECT_NEAR(std::hypot(x - 128, y - 128), 50, 0.5);
  }
}

TEST(PenAreas, ThickAreasAreTheirOutlinesUnchanged) {
  const auto outline = CircleOutline({128, 128}, 40);
  const auto strokes = StrokesOfOne(AreaOf({outline}));
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].points, StrokesThrough({outline})[0].points);
}

TEST(PenAreas, DotsOfABoldPenAreKept) {
  // Wider than any line may be (0.06 * 256), but no thicker than 2.4 widths of the pen.
  const auto dot = CircleOutline({128, 60}, 10);
  const auto strokes = StrokesOfAreas({AreaOf({BarOutline(40, 195, 220, 205)}), AreaOf({dot})}, 256.0);
  ASSERT_EQ(strokes[0].size(), 1U);
  ASSERT_EQ(strokes[1].size(), 1U);
  EXPECT_EQ(strokes[1][0].points, StrokesThrough({dot})[0].points);
  // A blob twice as long as wide is its middle line.
  const auto blob =
      StrokesOfAreas({AreaOf({BarOutline(40, 195, 220, 205)}), AreaOf({BarOutline(100, 50, 140, 70)})}, 256.0)[1];
  ASSERT_EQ(blob.size(), 1U);
  for (const auto& [x, y] : blob[0].points) EXPECT_NEAR(y, 60, 1.0);
}

TEST(PenAreas, DotsOfAThinPenAreKept) {
  const auto dot = CircleOutline({128, 60}, 2.5);
  const auto strokes = StrokesOfAreas({AreaOf({BarOutline(40, 198, 220, 202)}), AreaOf({dot})}, 256.0);
  ASSERT_EQ(strokes[1].size(), 1U);
  EXPECT_GT(strokes[1][0].points.size(), 1U);
}

TEST(PenAreas, PaperOverAnAreaLeavesALine) {
  auto paper = AreaOf({CircleOutline({128, 128}, 48)});
  paper.paint = Paint::kPaper;
  const auto strokes = StrokesOfAreas({AreaOf({CircleOutline({128, 128}, 52)}), paper}, 256.0);
  ASSERT_EQ(strokes[0].size(), 1U);
  EXPECT_TRUE(strokes[1].empty());
  for (const auto& [x, y] : strokes[0][0].points) EXPECT_NEAR(std::hypot(x - 128, y - 128), 50, 0.5);
}

TEST(PenAreas, ShortAreasThatTouchAreOneLine) {
  std::vector<PaintedArea> areas;
  for (int i = 0; i < 20; ++i) areas.push_back(AreaOf({BarOutline(40 + 4 * i, 98, 44 + 4 * i, 102)}));
  size_t num_strokes = 0;
  for (const auto& strokes : StrokesOfAreas(areas, 256.0)) num_strokes += strokes.size();
  EXPECT_EQ(num_strokes, 1U);
}

TEST(PenAreas, NibThatLosesItsWidthOnTheWayIsOneLine) {
  // The sides cross at (90, 100).
  const OutlinePoints crossed{{40, 97}, {140, 103}, {140, 97}, {40, 103}};
  const auto strokes = StrokesOfOne(AreaOf({crossed}));
  ASSERT_EQ(strokes.size(), 1U);
  for (const auto& [x, y] : strokes[0].points) EXPECT_NEAR(y, 100, 0.5);
  EXPECT_NEAR(std::abs(strokes[0].points.front()[0] - strokes[0].points.back()[0]), 95, 7);
}

TEST(PenAreas, OfAnElementOfManyStrokesEachIsReadItsOwnWay) {
  const OutlinePoints crossed{{40, 97}, {140, 103}, {140, 97}, {40, 103}};
  const auto strokes = StrokesOfOne(AreaOf({BarOutline(40, 150, 140, 154), crossed}));
  ASSERT_EQ(strokes.size(), 2U);
  const auto is_at = [](double height) {
    return [=](const Stroke& stroke) { return std::abs(stroke.points[0][1] - height) < 1.0; };
  };
  EXPECT_EQ(std::ranges::count_if(strokes, is_at(152)), 1);
  EXPECT_EQ(std::ranges::count_if(strokes, is_at(100)), 1);
}

TEST(PenAreas, DrawnLineIsTakenWhereItIsInTheMiddle) {
  auto area = AreaOf({BarOutline(40, 98, 140, 102)});
  area.drawn_lines = {{{40, 100.25}, {140, 100.25}}};
  EXPECT_EQ(StrokesOfOne(area)[0].points, StrokesThrough(area.drawn_lines)[0].points);
  area.drawn_lines = {{{40, 150}, {140, 150}}};
  EXPECT_NE(StrokesOfOne(area)[0].points, StrokesThrough(area.drawn_lines)[0].points);
}

TEST(PenAreas, AreasWithoutInsideAreTheirOutlines) {
  EXPECT_EQ(StrokesOfOne(AreaOf({{{1, 1}, {9, 1}}})).size(), 1U);
  EXPECT_TRUE(StrokesOfOne(AreaOf({})).empty());
  testing::ExpectError([] { StrokesOfAreas({}, 0.0); }, "expected a positive size");
}

}  // namespace
}  // namespace daumier::render
