#include "render/skeleton_graph.h"

#include "core/error.h"
#include "render/draw.h"
#include "render/ink.h"
#include "render/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace daumier::render {
namespace {

/// '#' is ink.
Image Mask(const std::vector<std::string>& rows) {
  Image mask(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), 1, kPaper);
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column) {
      if (rows[row][column] == '#') mask.at(row, column) = kInk;
    }
  }
  return mask;
}

SkeletonGraph GraphOf(const Image& skeleton) {
  return GraphOfSkeleton(skeleton, skeleton);
}

std::vector<int> SortedDegrees(const SkeletonGraph& graph) {
  auto degrees = graph.Degrees();
  std::sort(degrees.begin(), degrees.end());
  return degrees;
}

void FillInk(Image& image, int top, int left, int height, int width) {
  FillRectangle(image, top, left, height, width, {kInk, kInk, kInk});
}

TEST(SkeletonGraph, LineHasTwoEndsAndAllItsPixels) {
  const auto graph = GraphOf(Mask({".......",  //
                                   ".####..",  //
                                   ".....#."}));
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.nodes.size(), 2U);
  const auto& points = graph.edges[0].points;
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points.front(), Eigen::Vector2d(1.5, 1.5));
  EXPECT_EQ(points.back(), Eigen::Vector2d(5.5, 2.5));
  EXPECT_DOUBLE_EQ(graph.edges[0].Length(), 3.0 + std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(graph.nodes[0].radius, 0.5);
}

TEST(SkeletonGraph, JunctionOfThreeLinesIsOneNode) {
  const auto graph = GraphOf(Mask({".........",  //
                                   ".#######.",  //
                                   "....#....",  //
                                   "....#....",  //
                                   "....#...."}));
  EXPECT_EQ(SortedDegrees(graph), (std::vector{1, 1, 1, 3}));
  EXPECT_EQ(graph.edges.size(), 3U);
}

TEST(SkeletonGraph, ClosedLineHasOneNode) {
  const auto graph = GraphOf(Mask({"..##..",  //
                                   ".#..#.",  //
                                   ".#..#.",  //
                                   "..##.."}));
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].nodes[0], graph.edges[0].nodes[1]);
  EXPECT_EQ(graph.edges[0].points.size(), 9U);
  EXPECT_EQ(graph.edges[0].points.front(), graph.edges[0].points.back());
}

TEST(SkeletonGraph, DotIsAnEdgeOfOnePoint) {
  const auto graph = GraphOf(Mask({"...", ".#.", "..."}));
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].points, (std::vector{Eigen::Vector2d(1.5, 1.5)}));
  EXPECT_EQ(WithoutThinningArtefacts(graph).edges.size(), 1U);
}

TEST(SkeletonGraph, TwoEndsSideBySideAreOneLine) {
  const auto graph = GraphOf(Mask({"....", ".##.", "...."}));
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].points.size(), 2U);
}

TEST(SkeletonGraph, SpursShorterThanTheLineIsWideGo) {
  Image ink(80, 120, 1, kPaper);
  FillInk(ink, 40, 10, 9, 100);
  Image skeleton(80, 120, 1, kPaper);
  FillInk(skeleton, 44, 10, 1, 100);
  FillInk(skeleton, 36, 60, 8, 1);
  EXPECT_EQ(GraphOfSkeleton(skeleton, ink).edges.size(), 3U);
  EXPECT_EQ(WithoutThinningArtefacts(GraphOfSkeleton(skeleton, ink)).edges.size(), 2U);
  FillInk(skeleton, 26, 60, 18, 1);
  EXPECT_EQ(WithoutThinningArtefacts(GraphOfSkeleton(skeleton, ink)).edges.size(), 3U) << "a line of its own";
}

TEST(SkeletonGraph, BridgeOfACrossingBecomesOneJunction) {
  // Two lines that cross at a small angle: thinning joins them for a while.
  const std::vector<std::string> rows = {"#...........#", ".##.......##.", "...##...##...", ".....###.....",
                                         "...##...##...", ".##.......##.", "#...........#"};
  const Image skeleton = Mask(rows);
  Image ink(7, 13, 1, kPaper);
  FillInk(ink, 2, 0, 3, 13);
  const auto graph = GraphOfSkeleton(skeleton, ink);
  EXPECT_EQ(SortedDegrees(graph), (std::vector{1, 1, 1, 1, 3, 3}));
  const auto merged = WithoutThinningArtefacts(graph);
  EXPECT_EQ(SortedDegrees(merged), (std::vector{0, 1, 1, 1, 1, 4})) << "the node that went has no edges";
}

TEST(SkeletonGraph, TopologyOfARealSkeletonIsThatOfTheInk) {
  Image ink(100, 100, 1, kPaper);
  FillInk(ink, 20, 20, 60, 5);
  FillInk(ink, 20, 75, 60, 5);
  FillInk(ink, 20, 20, 5, 60);
  FillInk(ink, 75, 20, 5, 60);
  FillInk(ink, 48, 20, 5, 60);
  const auto graph = WithoutThinningArtefacts(GraphOfSkeleton(Thin(ink), ink));
  // The letter theta: two junctions, three lines between them.
  const auto degrees = graph.Degrees();
  EXPECT_EQ(std::count(degrees.begin(), degrees.end(), 3), 2);
  EXPECT_EQ(graph.edges.size(), 3U);
}

TEST(SkeletonGraph, RefusesASkeletonOfAnotherSize) {
  EXPECT_THROW(GraphOfSkeleton(Image(3, 4, 1), Image(4, 4, 1)), Error);
}

}  // namespace
}  // namespace daumier::render
