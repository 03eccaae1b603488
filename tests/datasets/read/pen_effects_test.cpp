#include "datasets/read/pen_effects.h"

#include "datasets/read/stroke_arc.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using render::Stroke;

Stroke Line(int num_points) {
  Stroke stroke{3, {}};
  for (int i = 0; i < num_points; ++i) stroke.points.push_back({static_cast<float>(i), 0});
  return stroke;
}

Stroke Circle(double radius) {
  Stroke stroke;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    stroke.points.push_back(ToPoint(Vector2d(128, 128) + radius * Vector2d(std::cos(angle), std::sin(angle))));
  }
  stroke.points.push_back(stroke.points.front());
  return stroke;
}

Vector2d Move(const Stroke& before, const Stroke& after, size_t i) {
  return ToVector(after.points[i]) - ToVector(before.points[i]);
}

TEST(Jitter, HasItsRootMeanSquareAndNothingMuchShorter) {
  // A cubic B-spline with knots l apart and rms s has slopes of rms s / l sqrt((2/3) / (151/315)) = 1.179 s / l.
  const Stroke line = Line(3000);
  double square = 0, slope = 0;
  int count = 0;
  Rng rng(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Stroke jittered = Jitter(line, 0.8, 16, rng);
    for (size_t i = 1; i < line.points.size(); ++i, ++count) {
      square += Move(line, jittered, i).squaredNorm() / 2;
      slope += (Move(line, jittered, i) - Move(line, jittered, i - 1)).squaredNorm() / 2;
    }
  }
  EXPECT_NEAR(std::sqrt(square / count), 0.8, 0.04);
  EXPECT_NEAR(std::sqrt(slope / count), 1.179 * 0.8 / 16, 0.004);
}

TEST(Jitter, IsTheSameAtEveryArcLength) {
  // Over many strokes; the rms of a cubic B-spline varies by 2 % between its knots.
  const Stroke line = Line(33);
  std::vector<double> squares(33, 0);
  Rng rng(2);
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Stroke jittered = Jitter(line, 1, 16, rng);
    for (size_t i = 0; i < 33; ++i) squares[i] += Move(line, jittered, i).squaredNorm() / 2 / kTrials;
  }
  for (const double square : squares) EXPECT_NEAR(std::sqrt(square), 1, 0.05);
}

TEST(Jitter, ClosedStrokesStayClosedAndSmoothAtTheSeam) {
  Rng rng(3);
  for (const double radius : {2.0, 20.0, 80.0}) {
    const Stroke circle = Circle(radius), jittered = Jitter(circle, 1, 16, rng);
    EXPECT_TRUE(IsClosed(jittered));
    const Vector2d bend = Move(circle, jittered, 1) - 2 * Move(circle, jittered, 0) + Move(circle, jittered, 99);
    EXPECT_LT(bend.norm(), 0.4);
  }
}

TEST(Jitter, MovesAPointAloneAndNothingByNothing) {
  Rng rng(4);
  const Stroke dot{0, {{5, 6}}};
  EXPECT_NE(Jitter(dot, 1, 16, rng).points, dot.points);
  EXPECT_EQ(Jitter(Line(20), 0, 16, rng).points, Line(20).points);
  EXPECT_EQ(Jitter(Line(20), 0, 16, rng).kind, 3);
  EXPECT_TRUE(Jitter({}, 1, 16, rng).points.empty());
  for (const auto& point : Jitter({0, {{1, 2}, {1, 2}, {1, 2}}}, 1, 16, rng).points)
    EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]));
}

using Points = std::vector<std::array<float, 2>>;

TEST(CutOut, PiecesEndExactlyAtTheGap) {
  const CutStroke cut = CutOut(Line(6), 1.25, 3.5);
  ASSERT_EQ(cut.pieces.size(), 2u);
  EXPECT_EQ(cut.pieces[0].points, (Points{{0, 0}, {1, 0}, {1.25f, 0}}));
  EXPECT_EQ(cut.pieces[1].points, (Points{{3.5f, 0}, {4, 0}, {5, 0}}));
  EXPECT_EQ(cut.pieces[0].kind, 3);
  EXPECT_EQ(cut.pieces[1].kind, 3);
  EXPECT_EQ(cut.visible, (std::vector<bool>{true, true, false, false, true, true}));
}

TEST(CutOut, AtAPointThePieceEndsThere) {
  const CutStroke cut = CutOut(Line(4), 1, 2);
  EXPECT_EQ(cut.pieces[0].points, (Points{{0, 0}, {1, 0}}));
  EXPECT_EQ(cut.pieces[1].points, (Points{{2, 0}, {3, 0}}));
  EXPECT_EQ(cut.visible, (std::vector<bool>{true, true, true, true}));
}

TEST(CutOut, LeavesOutPiecesWithoutLength) {
  const CutStroke end = CutOut(Line(4), 2.5, 3), begin = CutOut(Line(4), -1, 0.5), all = CutOut(Line(4), 0, 3);
  ASSERT_EQ(end.pieces.size(), 1u);
  EXPECT_EQ(end.pieces[0].points, (Points{{0, 0}, {1, 0}, {2, 0}, {2.5f, 0}}));
  EXPECT_EQ(end.visible, (std::vector<bool>{true, true, true, false}));
  ASSERT_EQ(begin.pieces.size(), 1u);
  EXPECT_EQ(begin.pieces[0].points, (Points{{0.5f, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_TRUE(all.pieces.empty());
  EXPECT_EQ(all.visible, std::vector<bool>(4, false));
}

TEST(CutOut, RefusesAGapThatEndsBeforeItBegins) {
  testing::ExpectError([] { CutOut(Line(4), 2, 1); }, "a gap from 2 to 1 pixels");
}

}  // namespace
}  // namespace daumier::datasets
