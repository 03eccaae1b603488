#include "render/loose_ends.h"

#include "render/draw.h"
#include "render/ink.h"
#include "render/skeleton_tracing.h"
#include "render/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::render {
namespace {

TEST(LooseEnds, LineThatIsCutStraightReachesItsEnds) {
  Image bar(40, 120, 1, kPaper);
  FillRectangle(bar, 14, 20, 12, 80, {kInk, kInk, kInk});
  const auto graph = WithoutThinningArtefacts(GraphOfSkeleton(Thin(bar), bar));
  const auto strokes = WithFullEnds(TraceSkeleton(graph), graph, bar, 12.0);
  ASSERT_EQ(strokes.size(), 1U);
  const auto& points = strokes[0].points;
  EXPECT_NEAR(std::min(points.front()[0], points.back()[0]), 20, 1.0);
  EXPECT_NEAR(std::max(points.front()[0], points.back()[0]), 100, 1.0);
  for (const auto& [x, y] : points) EXPECT_NEAR(y, 20, 1.0);
}

TEST(LooseEnds, RoundEndsAndDotsStay) {
  const Image ink = RasteriseStrokes({{0, {{60, 128}, {200, 128}}}, {0, {{30, 30}}}}, kSketchCanvas,
                                     {.width = 12.0, .antialias = false});
  const auto graph = WithoutThinningArtefacts(GraphOfSkeleton(Thin(ink), ink));
  const auto traced = TraceSkeleton(graph);
  for (const Stroke& stroke : WithFullEnds(traced, graph, ink, 12.0)) {
    if (stroke.points.size() == 1) continue;
    EXPECT_NEAR(std::min(stroke.points.front()[0], stroke.points.back()[0]), 60, 1.5);
    EXPECT_NEAR(std::max(stroke.points.front()[0], stroke.points.back()[0]), 200, 1.5);
  }
}

}  // namespace
}  // namespace daumier::render
