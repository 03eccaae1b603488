#include "systems/sketch/session_curves.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

/// Points at x = from, from + step, ... at one height.
CanvasPoints Row(double from, double to, double y, double step = 5) {
  CanvasPoints points;
  for (double x = from; x <= to + 1e-9; x += step) points.emplace_back(x, y);
  return points;
}

/// An upper and a lower lid from x = 100 to 160, a jaw, and a round brow.
SessionLines Face() {
  SessionLines lines;
  lines.curves.push_back({"upper_eye_left", "upper_eye", false, Row(100, 160, 100)});
  lines.curves.push_back({"lower_eye_left", "lower_eye", false, Row(100, 160, 110)});
  lines.curves.push_back({"jaw", "silhouette", false, Row(20, 220, 240)});
  SessionCurve brow{"brow_left", "brow", true, {}};
  for (int i = 0; i <= 24; ++i) {
    const double angle = 2 * M_PI * i / 24;
    brow.points.emplace_back(128 + 20 * std::cos(angle), 60 + 8 * std::sin(angle));
  }
  brow.points.back() = brow.points.front();
  lines.curves.push_back(brow);
  return lines;
}

TEST(SessionCurves, TheEraserTakesOneSegmentOfAFeatureCurve) {
  SessionLines lines = Face();
  ASSERT_TRUE(Erase(lines, {{130, 99}}));
  const CurveGap gap = *lines.curves[0].gap;  // 60 pixels: three segments, of 13 points.
  EXPECT_EQ(gap.first, 5u);
  EXPECT_EQ(gap.last, 8u);
  EXPECT_FALSE(lines.curves[1].gap.has_value());
}

TEST(SessionCurves, OfTheSilhouetteTheEraserTakesWhatItReachesAndWhatIsBetween) {
  SessionLines lines = Face();
  ASSERT_TRUE(Erase(lines, {{40, 240}, {50, 240}}));
  EXPECT_EQ(lines.curves[2].gap->first, 3u);  // x = 35, within reach.
  EXPECT_EQ(lines.curves[2].gap->last, 7u);   // x = 55
  ASSERT_TRUE(Erase(lines, {{100, 241}}));
  EXPECT_EQ(lines.curves[2].gap->first, 3u);
  EXPECT_EQ(lines.curves[2].gap->last, 16u);  // Within reach of 100 is 100 alone, at a distance of 1.
}

TEST(SessionCurves, WhereNothingIsNothingIsErased) {
  SessionLines lines = Face();
  EXPECT_FALSE(Erase(lines, {{128, 180}}));
  ExpectError([&] { Erase(lines, {}); }, "has no point");
}

TEST(SessionCurves, AStrokeFillsTheGapAndItsEndsSnap) {
  SessionLines lines = Face();
  Erase(lines, {{130, 99}});  // Points at 125 .. 140; open ends at 120 and 145.
  EXPECT_EQ(Draw(lines, {{122, 96}, {132, 90}, {143, 96}}), std::optional<size_t>(0));
  const CanvasPoints& points = lines.curves[0].points;
  EXPECT_FALSE(lines.curves[0].gap.has_value());
  EXPECT_EQ(points[4], Eigen::Vector2d(120, 100));
  EXPECT_EQ(points[9], Eigen::Vector2d(145, 100));
  for (size_t i = 5; i <= 8; ++i) EXPECT_LT(points[i].y(), 98) << i;
  EXPECT_TRUE(lines.wrinkles.empty());
  EXPECT_EQ(lines.curves[1].drawn, 0) << "its ends are where they were, so the partner stays";
}

TEST(SessionCurves, PointsLieOnTheStrokeByArcLength) {
  SessionLines lines = Face();
  Erase(lines, {{130, 99}});
  Draw(lines, {{120, 100}, {120, 80}, {145, 80}, {145, 100}});  // 65 pixels for 25; its ends are the open ends.
  const CanvasPoints& points = lines.curves[0].points;
  EXPECT_NEAR((points[5] - Eigen::Vector2d(120, 87)).norm(), 0, 1e-9);  // 13 of 65
  EXPECT_NEAR((points[6] - Eigen::Vector2d(126, 80)).norm(), 0, 1e-9);  // 26
  EXPECT_NEAR((points[8] - Eigen::Vector2d(145, 87)).norm(), 0, 1e-9);  // 52
}

TEST(SessionCurves, TheDirectionOfAStrokeDoesNotMatter) {
  SessionLines forward = Face(), backward = Face();
  const CanvasPoints stroke = {{122, 96}, {132, 90}, {143, 97}};
  for (SessionLines* lines : {&forward, &backward}) Erase(*lines, {{130, 99}});
  Draw(forward, stroke);
  Draw(backward, {stroke.rbegin(), stroke.rend()});
  for (size_t i = 0; i < forward.curves[0].points.size(); ++i)
    EXPECT_LT((forward.curves[0].points[i] - backward.curves[0].points[i]).norm(), 1e-9);
}

TEST(SessionCurves, ClosedLipsStayClosedInASmile) {
  SessionLines lines;
  lines.curves.push_back({"upper_mouth", "upper_mouth", false, Row(100, 160, 200)});
  lines.curves.push_back({"lower_mouth", "lower_mouth", false, Row(100, 160, 200, 6)});
  for (double x = 100; x <= 160; x += 5) Erase(lines, {{x, 200}});
  Erase(lines, {{160, 200}});
  ASSERT_TRUE(lines.curves[0].gap.has_value());
  const CurveGap gap = *lines.curves[0].gap;
  ASSERT_EQ(gap.last - gap.first + 1, lines.curves[0].points.size()) << "the whole lip is erased";
  const size_t drawn = Draw(lines, {{100, 200}, {130, 220}, {160, 200}}).value();
  EXPECT_EQ(drawn, 0u);
  const CanvasPoints &upper = lines.curves[0].points, &lower = lines.curves[1].points;
  EXPECT_NEAR(lower[lower.size() / 2].y(), 220, 1e-6) << "the lower lip is not left above the upper one";
  for (const Eigen::Vector2d& point : lower) EXPECT_LT(datasets::DistanceTo(upper, point), 1e-6);
  EXPECT_EQ(lines.curves[1].drawn, 1);
}

TEST(SessionCurves, AnOpenedLipLeavesItsPartner) {
  SessionLines lines;
  lines.curves.push_back({"upper_mouth", "upper_mouth", false, Row(100, 160, 200)});
  lines.curves.push_back({"lower_mouth", "lower_mouth", false, Row(100, 160, 200)});
  const CanvasPoints before = lines.curves[1].points;
  for (double x = 100; x <= 160; x += 5) Erase(lines, {{x, 200}});
  ASSERT_TRUE(Draw(lines, {{100, 200}, {130, 180}, {160, 200}}).has_value());
  EXPECT_EQ(lines.curves[1].points, before);
  EXPECT_EQ(lines.curves[1].drawn, 0);
}

TEST(SessionCurves, ARedrawnLidCarriesItsPartnerAlong) {
  SessionLines lines = Face();
  for (const double x : {110.0, 130.0, 150.0}) Erase(lines, {{x, 99}});
  ASSERT_EQ(lines.curves[0].gap->last, 12u);
  Draw(lines, {{90, 95}, {130, 80}, {170, 95}});
  const CanvasPoints& lower = lines.curves[1].points;
  // The upper lid's ends went from (100, 100) and (160, 100) to (90, 95) and (170, 95): scale 4/3 about the first.
  EXPECT_LT((lower.front() - Eigen::Vector2d(90, 95 + 10 * 4.0 / 3)).norm(), 1e-9);
  EXPECT_LT((lower.back() - Eigen::Vector2d(170, 95 + 10 * 4.0 / 3)).norm(), 1e-9);
  EXPECT_EQ(lines.curves[1].drawn, lines.curves[0].drawn);
  EXPECT_EQ(PartnerOf("lower_mouth"), "upper_mouth");
  EXPECT_EQ(PartnerOf("jaw"), "");
}

TEST(SessionCurves, AClosedCurveIsRedrawnFromItsBeginning) {
  SessionLines lines = Face();
  const SessionCurve before = lines.curves[3];
  Erase(lines, {{148, 60}});
  ASSERT_TRUE(lines.curves[3].gap.has_value());
  EXPECT_GE(lines.curves[3].gap->first, 1u) << "its beginning stays while others are there";
  for (const Eigen::Vector2d& point : before.points) Erase(lines, {point});
  ASSERT_EQ(lines.curves[3].gap->first, 0u);
  ASSERT_EQ(lines.curves[3].gap->last, 24u);
  CanvasPoints larger;  // Begins at the left, runs the other way.
  for (int i = 0; i < 48; ++i) {
    const double angle = M_PI - 2 * M_PI * i / 48;
    larger.emplace_back(128 + 30 * std::cos(angle), 60 + 12 * std::sin(angle));
  }
  EXPECT_EQ(Draw(lines, larger), std::optional<size_t>(3));
  const CanvasPoints& points = lines.curves[3].points;
  EXPECT_EQ(points.front(), points.back());
  for (int i = 0; i <= 24; ++i) {
    const double angle = 2 * M_PI * i / 24;
    EXPECT_LT((points[size_t(i)] - Eigen::Vector2d(128 + 30 * std::cos(angle), 60 + 12 * std::sin(angle))).norm(), 2.5)
        << i;
  }
}

TEST(SessionCurves, AllOtherStrokesAreWrinklesAndCanBeErased) {
  SessionLines lines = Face();
  EXPECT_EQ(Draw(lines, {{60, 150}, {70, 155}}), std::nullopt);
  Erase(lines, {{130, 99}});
  EXPECT_EQ(Draw(lines, {{60, 200}, {70, 205}}), std::nullopt) << "far from the gap";
  EXPECT_EQ(lines.wrinkles.size(), 2u);
  EXPECT_TRUE(Erase(lines, {{60, 151}}));
  ASSERT_EQ(lines.wrinkles.size(), 1u);
  EXPECT_EQ(lines.wrinkles[0].points.front(), Eigen::Vector2d(60, 200));
}

TEST(SessionCurves, TheStrokesAreTheCurvesWithoutTheirGaps) {
  SessionLines lines = Face();
  Draw(lines, {{60, 150}, {70, 155}});
  EXPECT_EQ(StrokesOf(lines).size(), 5u);
  Erase(lines, {{130, 99}});
  const std::vector<render::Stroke> strokes = StrokesOf(lines);
  ASSERT_EQ(strokes.size(), 6u);
  EXPECT_EQ(strokes[0].points.size(), 5u);
  EXPECT_EQ(strokes[1].points.size(), 4u);
}

TEST(SessionCurves, ARedrawnLineKeepsTheWidthsOfItsStroke) {
  SessionLines lines = Face();
  Erase(lines, {{130, 99}});  // Points 5 to 8, the open ends at 120 and 145.
  Draw(lines, {{145, 100}, {120, 100}}, {6, 1});
  const std::vector<double>& widths = lines.curves[0].widths;
  ASSERT_EQ(widths.size(), lines.curves[0].points.size());
  EXPECT_EQ(widths[4], 0) << "as it was";
  EXPECT_NEAR(widths[5], 2, 1e-9) << "a fifth of the way, from the thin end";
  EXPECT_NEAR(widths[8], 5, 1e-9);
  EXPECT_EQ(widths[9], 0);
  Draw(lines, {{60, 150}, {70, 155}}, {3, 3});
  const auto strokes = WeightedStrokesOf(lines);
  EXPECT_FLOAT_EQ(strokes[0].widths[8], 5);
  EXPECT_TRUE(strokes[1].widths.empty());
  EXPECT_EQ(strokes.back().widths, (std::vector<float>{3, 3}));
  SessionLines later = Face();
  KeepWidths(later, lines);
  EXPECT_EQ(later.curves[0].widths, widths);
  Erase(lines, {{130, 99}});
  Draw(lines, {{120, 100}, {145, 100}});
  EXPECT_EQ(lines.curves[0].widths[6], 0) << "of a stroke without a weight";
  ExpectError([&] { Draw(lines, {{60, 150}, {70, 155}}, {3}); }, "1 widths of 2 points");
}

TEST(SessionCurves, AClosedCurveHasTheWidthsOfItsLoop) {
  SessionLines lines = Face();
  const CanvasPoints old = lines.curves[3].points;
  for (const Eigen::Vector2d& point : old) Erase(lines, {point});
  CanvasPoints loop;
  std::vector<double> widths;
  for (int i = 0; i <= 48; ++i) {  // From the left, thin on the left and thick on the right.
    const double angle = M_PI - 2 * M_PI * i / 48;
    loop.emplace_back(128 + 30 * std::cos(angle), 60 + 12 * std::sin(angle));
    widths.push_back(3 + 2 * std::cos(angle));
  }
  ASSERT_EQ(Draw(lines, loop, widths), std::optional<size_t>(3));
  for (size_t i = 0; i < lines.curves[3].points.size(); ++i)
    EXPECT_NEAR(lines.curves[3].widths[i], 3 + (lines.curves[3].points[i].x() - 128) / 15, 0.1);
}

TEST(SessionCurves, RefusesStrokesThatAreNone) {
  SessionLines lines = Face();
  ExpectError([&] { Draw(lines, {}); }, "shorter than a pixel");
  ExpectError([&] { Draw(lines, {{1, 1}, {1.5, 1}}); }, "shorter than a pixel");
  ExpectError([&] { Draw(lines, {{1, 1}, {NAN, 1}}); }, "not finite");
}

}  // namespace
}  // namespace daumier::sketch
