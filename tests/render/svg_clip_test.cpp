#include "render/svg_clip.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

SvgPolyline ClipSquare(double low, double high) {
  return {{{low, low}, {high, low}, {high, high}, {low, high}, {low, low}}};
}

std::vector<SvgPolyline> Clipped(const SvgClip& clip, const SvgPolyline& polyline) {
  SvgWork work("a.svg");
  return clip.Clip(polyline, work);
}

TEST(SvgClip, PiecesAreWorkedOutByHand) {
  const SvgClip clip({{{ClipSquare(0, 10)}}});
  const auto pieces = Clipped(clip, {{{-5, 5}, {5, 5}, {15, 5}, {15, 2}, {5, 2}}});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].points, (std::vector<Vector2d>{{0, 5}, {5, 5}, {10, 5}}));
  EXPECT_EQ(pieces[1].points, (std::vector<Vector2d>{{10, 2}, {5, 2}}));
}

TEST(SvgClip, WhatLiesInsideIsUnchangedAndOutsideIsGone) {
  const SvgClip clip({{{ClipSquare(0, 10)}}});
  const SvgPolyline inside{{{1, 1}, {9, 1}, {9, 9}}};
  ASSERT_EQ(Clipped(clip, inside).size(), 1U);
  EXPECT_EQ(Clipped(clip, inside)[0].points, inside.points);
  EXPECT_TRUE(Clipped(clip, {{{20, 20}, {30, 0}}}).empty());
  EXPECT_EQ(Clipped(clip, {{{3, 3}}}).size(), 1U);
  EXPECT_TRUE(Clipped(clip, {{{30, 3}}}).empty());
  EXPECT_TRUE(Clipped(SvgClip({}), inside).empty()) << "an empty clip shows nothing";
}

TEST(SvgClip, RulesDecideAboutHoles) {
  const std::vector<SvgPolyline> rings{ClipSquare(0, 10), ClipSquare(3, 7)};
  EXPECT_TRUE(SvgClip({{rings, FillRule::kNonzero}}).Contains({5, 5}));
  EXPECT_FALSE(SvgClip({{rings, FillRule::kEvenOdd}}).Contains({5, 5}));
  EXPECT_TRUE(SvgClip({{{rings[0]}, FillRule::kEvenOdd}, {{rings[1]}, FillRule::kEvenOdd}}).Contains({5, 5}))
      << "areas are united";
}

TEST(SvgClip, AClosedLineIsCutAtTheClipAlone) {
  const auto pieces = Clipped(SvgClip({{{ClipSquare(0, 10)}}}), ClipSquare(5, 15));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].points, (std::vector<Vector2d>{{5, 10}, {5, 5}, {10, 5}}));
}

TEST(SvgClip, LengthInsideACircleIsThatOfItsChord) {
  SvgPolyline circle;
  for (int i = 0; i <= 2000; ++i)
    circle.points.emplace_back(10 * std::cos(i * std::numbers::pi / 1000), 10 * std::sin(i * std::numbers::pi / 1000));
  const SvgClip clip({{{circle}}});
  for (const double y : {-9.0, -3.0, 0.1, 6.0}) {
    const auto pieces = Clipped(clip, {{{-50, y}, {50, y}}});
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_NEAR((pieces[0].points.back() - pieces[0].points.front()).norm(), 2 * std::sqrt(100 - y * y), 1e-3);
  }
}

TEST(SvgClip, WorkIsLimited) {
  SvgWork work("a.svg");
  work.Spend(4'000'000'000);
  testing::ExpectError([&] { work.Spend(1); }, "a.svg: the drawing is too large");
}

TEST(SvgClip, EdgesThatAreComparedAreWork) {
  // One segment within a box is compared with 4 edges, and its middle with 4: more than 1 + 4 + 4 units.
  const SvgClip clip({{{{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}}}}});
  SvgWork work("a.svg");
  work.Spend(4'000'000'000 - 9);
  testing::ExpectError([&] { clip.Clip({{{1, 1}, {2, 2}}}, work); }, "a.svg: the drawing is too large");
}

}  // namespace
}  // namespace daumier::render
