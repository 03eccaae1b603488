#include "datasets/read/stroke_arc.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

TEST(StrokeArc, MeasuresAndFindsPointsByHand) {
  const render::Stroke stroke{0, {{0, 0}, {3, 4}, {3, 4}, {3, 10}}};
  const StrokeArc arc(stroke);
  EXPECT_EQ(arc.length(), 11);
  EXPECT_EQ(arc.arc_lengths(), (std::vector<double>{0, 5, 5, 11}));
  EXPECT_LT((arc.PointAt(2.5) - Vector2d(1.5, 2)).norm(), 1e-12);
  EXPECT_EQ(arc.PointAt(5), Vector2d(3, 4));
  EXPECT_EQ(arc.PointAt(8), Vector2d(3, 7));
}

TEST(StrokeArc, EndsExtendConstantly) {
  const render::Stroke stroke{0, {{0, 0}, {3, 4}}}, dot{0, {{7, 8}}};
  EXPECT_EQ(StrokeArc(stroke).PointAt(-1), Vector2d(0, 0));
  EXPECT_EQ(StrokeArc(stroke).PointAt(6), Vector2d(3, 4));
  EXPECT_EQ(StrokeArc(dot).PointAt(3), Vector2d(7, 8));
}

TEST(StrokeArc, HasNoLengthBelowTwoPoints) {
  const render::Stroke dot{0, {{7, 8}}}, nothing;
  EXPECT_EQ(StrokeArc(dot).length(), 0);
  EXPECT_EQ(StrokeArc(nothing).length(), 0);
  testing::ExpectError([&] { StrokeArc(nothing).PointAt(0); }, "without points");
}

TEST(IsClosed, RequiresThreePointsThatEndWhereTheyBegin) {
  EXPECT_TRUE(IsClosed({0, {{1, 2}, {5, 5}, {1, 2}}}));
  EXPECT_FALSE(IsClosed({0, {{1, 2}, {5, 5}, {1, 3}}}));
  EXPECT_FALSE(IsClosed({0, {{1, 2}, {1, 2}}}));
  EXPECT_FALSE(IsClosed({}));
}

}  // namespace
}  // namespace daumier::datasets
