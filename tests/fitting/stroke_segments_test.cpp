#include "fitting/stroke_segments.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

TEST(StrokeSegments, NearestIsAFootOrAnEnd) {
  const Segment segment = SegmentsOf({{0, {{0, 0}, {10, 0}}}}).front();
  EXPECT_EQ(segment.Nearest({4, 3}), Vector2f(4, 0));
  EXPECT_EQ(segment.Nearest({-5, 3}), Vector2f(0, 0));
  EXPECT_EQ(segment.Nearest({50, 3}), Vector2f(10, 0));
  EXPECT_EQ(segment.direction, Vector2f(1, 0));
}

TEST(StrokeSegments, APointAloneIsAPieceWithoutLength) {
  const auto segments = SegmentsOf({{0, {{3, 4}}}, {0, {}}, {0, {{1, 1}, {2, 1}, {2, 3}}}});
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0].Nearest({9, 9}), Vector2f(3, 4));
  EXPECT_EQ(segments[0].direction, Vector2f(0, 0));
  EXPECT_EQ(segments[2].direction, Vector2f(0, 1));
}

TEST(SegmentGrid, FindsWhatASearchThroughAllSegmentsFinds) {
  Rng rng = Stream(3, "segments");
  std::vector<render::Stroke> strokes;
  for (int i = 0; i < 40; ++i) {
    const auto x = float(rng.Uniform(-40, 300)), y = float(rng.Uniform(-40, 300));
    strokes.push_back({0, {{x, y}, {x + float(rng.Uniform(-30, 30)), y + float(rng.Uniform(-30, 30))}}});
  }
  const auto segments = SegmentsOf(strokes);
  constexpr float kReach = 12, kCosine = 0.8f;
  const SegmentGrid grid(segments, kReach);
  int num_found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector2f point(float(rng.Uniform(0, 256)), float(rng.Uniform(0, 256)));
    const Vector2f direction = Unit({float(rng.Uniform(-1, 1)), float(rng.Uniform(-1, 1))});
    float best = kReach;
    for (const Segment& segment : segments) {
      if (std::abs(segment.direction.dot(direction)) >= kCosine)
        best = std::min(best, (segment.Nearest(point) - point).norm());
    }
    const auto found = grid.Nearest(point, direction, kReach, kCosine);
    EXPECT_EQ(found.has_value(), best < kReach);
    if (found) {
      EXPECT_FLOAT_EQ((*found - point).norm(), best);
    }
    num_found += found.has_value();
  }
  EXPECT_GT(num_found, 30);
}

TEST(SegmentGrid, RefusesAReachOfNothing) {
  testing::ExpectError([] { SegmentGrid({}, 0); }, "a reach of 0");
}

}  // namespace
}  // namespace daumier::fitting
