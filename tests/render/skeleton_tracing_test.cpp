#include "render/skeleton_tracing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Points a pixel apart.
std::vector<Vector2d> Straight(const Vector2d& from, const Vector2d& to) {
  const int num_steps = static_cast<int>(std::lround((to - from).norm()));
  std::vector<Vector2d> points;
  for (int i = 0; i <= num_steps; ++i) points.push_back(from + (to - from) * i / num_steps);
  return points;
}

/// Lines from the node 0 at (100, 100) in directions in degrees, 60 pixels long.
SkeletonGraph Star(const std::vector<double>& degrees) {
  SkeletonGraph graph;
  graph.nodes.push_back({{100, 100}, 2.0});
  for (const double degree : degrees) {
    const double angle = degree * std::numbers::pi / 180.0;
    const Vector2d end = Vector2d(100, 100) + 60.0 * Vector2d(std::cos(angle), std::sin(angle));
    graph.nodes.push_back({end, 2.0});
    graph.edges.push_back({{0, static_cast<int>(graph.nodes.size()) - 1}, Straight({100, 100}, end)});
  }
  return graph;
}

void ExpectNear(const std::array<float, 2>& point, double x, double y, double tolerance = 1e-3) {
  EXPECT_NEAR(point[0], x, tolerance);
  EXPECT_NEAR(point[1], y, tolerance);
}

TEST(TraceSkeleton, StraightLineIsItsTwoEnds) {
  SkeletonGraph graph{{{{10, 10}, 1.0}, {{70, 40}, 1.0}}, {{{0, 1}, Straight({10, 10}, {70, 40})}}};
  const auto strokes = TraceSkeleton(graph);
  ASSERT_EQ(strokes.size(), 1U);
  ASSERT_EQ(strokes[0].points.size(), 2U);
  ExpectNear(strokes[0].points[0], 10, 10);
  ExpectNear(strokes[0].points[1], 70, 40);
}

TEST(TraceSkeleton, CrossingIsTwoStrokesThatGoStraightOn) {
  const auto strokes = TraceSkeleton(Star({0, 70, 180, 250}));
  ASSERT_EQ(strokes.size(), 2U);
  for (const auto& stroke : strokes) {
    ASSERT_EQ(stroke.points.size(), 2U);
    EXPECT_NEAR(stroke.points[0][0] + stroke.points[1][0], 200.0, 1e-3) << "ends are opposite";
  }
}

TEST(TraceSkeleton, SideLineEndsOnTheLineThatContinues) {
  const auto strokes = TraceSkeleton(Star({0, 90, 180}));
  ASSERT_EQ(strokes.size(), 2U);
  const auto& side = std::abs(strokes[0].points[0][1] - strokes[0].points.back()[1]) > 1 ? strokes[0] : strokes[1];
  ASSERT_EQ(side.points.size(), 2U);
  EXPECT_NEAR(std::min(side.points[0][1], side.points[1][1]), 100.0, 1e-3);
}

TEST(TraceSkeleton, SharpTurnAtAJunctionEndsAStroke) {
  EXPECT_EQ(TraceSkeleton(Star({0, 120, 240})).size(), 3U);
  EXPECT_EQ(TraceSkeleton(Star({0, 135, 240})).size(), 2U) << "45 degrees continue";
}

TEST(TraceSkeleton, CornerWithoutJunctionContinues) {
  EXPECT_EQ(TraceSkeleton(Star({0, 60})).size(), 1U);
}

TEST(TraceSkeleton, StepsOfPixelsAreSmoothedAway) {
  // y = 20 + x / 5, as pixels have it.
  SkeletonGraph graph{{{{0.5, 20.5}, 1.0}, {{100.5, 40.5}, 1.0}}, {{{0, 1}, {}}}};
  for (int x = 0; x <= 100; ++x) graph.edges[0].points.emplace_back(x + 0.5, 20.5 + std::floor(x / 5.0 + 0.5));
  const auto strokes = TraceSkeleton(graph);
  ASSERT_EQ(strokes.size(), 1U);
  for (const auto& [x, y] : strokes[0].points) EXPECT_NEAR(y, 20.5 + (x - 0.5) / 5.0, 0.45);
  EXPECT_LT(strokes[0].points.size(), 25U);
}

TEST(TraceSkeleton, ClosedLineEndsWhereItBeginsAndKeepsItsShape) {
  SkeletonGraph graph{{{{80, 50}, 1.0}}, {{{0, 0}, {}}}};
  for (int i = 0; i <= 180; ++i) {
    const double angle = 2 * std::numbers::pi * (i % 180) / 180;
    graph.edges[0].points.emplace_back(50 + 30 * std::cos(angle), 50 + 30 * std::sin(angle));
  }
  const auto strokes = TraceSkeleton(graph);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].points.front(), strokes[0].points.back());
  // A Gaussian of deviation s shrinks a circle of radius r by s^2 / (2 r) = 0.1.
  for (const auto& [x, y] : strokes[0].points) EXPECT_NEAR(std::hypot(x - 50, y - 50), 30.0, 0.4);
}

TEST(TraceSkeleton, DotIsAStrokeOfOnePoint) {
  SkeletonGraph graph{{{{7.5, 8.5}, 1.0}}, {{{0, 0}, {{7.5, 8.5}}}}};
  const auto strokes = TraceSkeleton(graph);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].points, (std::vector<std::array<float, 2>>{{7.5F, 8.5F}}));
}

TEST(TraceSkeleton, NothingGivesNothing) {
  EXPECT_TRUE(TraceSkeleton({}).empty());
}

}  // namespace
}  // namespace daumier::render
