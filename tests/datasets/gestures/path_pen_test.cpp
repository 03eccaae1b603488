#include "datasets/gestures/path_pen.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

TEST(PathPen, AFullTurnEndsWhereItBegan) {
  PathPen pen(0.3);
  pen.Arc(-2 * pi, 0.7);
  EXPECT_LT(pen.at().norm(), 1e-12);
  EXPECT_NEAR(pen.heading(), 0.3 - 2 * pi, 1e-12);
  EXPECT_NEAR(LengthOf(pen.points()), 2 * pi * 0.7, 0.01);
}

TEST(PathPen, TurnsClockwiseOnTheScreen) {
  PathPen pen;
  pen.Forward(1).Turn(pi / 2).Forward(2);
  EXPECT_LT((pen.at() - Vector2d(1, 2)).norm(), 1e-12);
  pen.Arc(pi / 2, 1);
  EXPECT_LT((pen.at() - Vector2d(0, 3)).norm(), 1e-12);
}

TEST(PathPen, PointsAreAStepApartAtMost) {
  const Polyline line = PathPen().To({0.5, -0.2}).Arc(2, 0.5).points();
  for (size_t i = 1; i < line.size(); ++i) EXPECT_LE((line[i] - line[i - 1]).norm(), PathPen::kStep + 1e-9);
}

TEST(Aimed, PutsTheLastPointInThatDirectionFromTheFirst) {
  const Polyline aimed = Aimed({{1, 1}, {5, 0}, {4, 5}}, pi / 2);
  EXPECT_NEAR(aimed.back().x(), aimed.front().x(), 1e-12);
  EXPECT_NEAR(aimed.back().y() - aimed.front().y(), 5, 1e-12);
  EXPECT_EQ(Scaled({{2, 3}}, -1, 2), (Polyline{{-2, 6}}));
  EXPECT_LT((Turned({{1, 0}}, pi / 2)[0] - Vector2d(0, 1)).norm(), 1e-12);
}

TEST(LogUniform, StaysInItsRange) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const double value = LogUniform(0.1, 10, rng);
    EXPECT_GE(value, 0.1);
    EXPECT_LT(value, 10);
    EXPECT_EQ(std::abs(EitherSign(rng)), 1);
  }
}

}  // namespace
}  // namespace daumier::datasets
