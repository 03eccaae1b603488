#include "fitting/stroke_distance.h"

#include "core/random.h"
#include "fitting/stroke_segments.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

using StrokeList = std::vector<render::Stroke>;

const StrokeList kLine = {{0, {{10, 50}, {110, 50}}}};

TEST(StrokeDistance, ParallelLinesAreTheirGapApart) {
  const StrokeDistance distance = DistanceBetween(kLine, {{0, {{10, 53}, {110, 53}}}});
  EXPECT_NEAR(distance.drawn_to_projected, 3, 1e-5);
  EXPECT_NEAR(distance.projected_to_drawn, 3, 1e-5);
  EXPECT_NEAR(distance.two_way(), 3, 1e-5);
}

TEST(StrokeDistance, IsNoughtBetweenALineAndItself) {
  EXPECT_NEAR(DistanceBetween(kLine, kLine).two_way(), 0, 1e-6);
}

TEST(StrokeDistance, EachWayIsItsOwnMean) {
  // The drawn line is twice as long: its second half is 0 .. 100 away from the end of the other, 50 in the mean.
  const StrokeDistance distance = DistanceBetween({{0, {{10, 50}, {210, 50}}}}, kLine);
  EXPECT_NEAR(distance.drawn_to_projected, 25, 1e-3);
  EXPECT_NEAR(distance.projected_to_drawn, 0, 1e-6);
  EXPECT_NEAR(distance.two_way(), 12.5, 1e-3);
}

TEST(StrokeDistance, LengthCountsNotTheNumberOfPoints) {
  // 100 px at distance 0 in many pieces, 100 px at distance 10 in one.
  StrokeList drawn = {{0, {}}, {0, {{10, 60}, {110, 60}}}};
  for (int i = 0; i <= 1000; ++i) drawn[0].points.push_back({10 + 0.1f * float(i), 50});
  EXPECT_NEAR(DistanceBetween(drawn, kLine).drawn_to_projected, 5, 1e-2);
}

TEST(StrokeDistance, TrimmingLeavesOutTheFarthestShare) {
  // A tenth of the drawn length is hair.
  const StrokeList drawn = {{0, {{10, 52}, {100, 52}}}, {0, {{300, 10}, {300, 20}}}};
  EXPECT_GT(DistanceBetween(drawn, kLine).drawn_to_projected, 15);
  EXPECT_NEAR(DistanceBetween(drawn, kLine, 0.1).drawn_to_projected, 2, 1e-4);
  EXPECT_NEAR(DistanceBetween(kLine, drawn, 0, 0.1).projected_to_drawn, 2, 1e-4);
}

TEST(StrokeDistance, DotsAreReachedButHaveNoLength) {
  const StrokeList with_dot = {{0, {{10, 50}, {60, 50}}}, {0, {{110, 50}}}};
  EXPECT_NEAR(DistanceBetween(with_dot, kLine).drawn_to_projected, 0, 1e-5);
  // From 60 to 110 a point is at most 25 away from the line's end or from the dot: 12.5 in the mean of that half.
  EXPECT_NEAR(DistanceBetween(with_dot, kLine).projected_to_drawn, 6.25, 1e-3);
}

TEST(StrokeDistance, RefusesNothingAndTooMuchTrimming) {
  testing::ExpectError([] { DistanceBetween({}, kLine); }, "without any length");
  testing::ExpectError([] { DistanceBetween(kLine, {{0, {{3, 3}}}}); }, "without any length");
  testing::ExpectError([] { DistanceBetween(kLine, kLine, 1.0); }, "a share of 1");
}

// Every segment held against every point.
TEST(DistanceBetween, IsThatOfTheNearestOfThousandsOfSegments) {
  Rng rng(8);
  const auto scribble = [&](int count, double low, double high) {
    render::Stroke stroke;
    for (int i = 0; i < count; ++i)
      stroke.points.push_back({float(rng.Uniform(low, high)), float(rng.Uniform(low, high))});
    return std::vector<render::Stroke>{stroke};
  };
  const auto drawn = scribble(3000, 0, 250);
  std::vector<render::Stroke> dots;
  double sum = 0, length = 0;
  for (int i = 0; i < 60; ++i) {
    const auto dash = scribble(2, -40, 290)[0];
    const Eigen::Vector2f from(dash.points[0][0], dash.points[0][1]), to = from + Eigen::Vector2f(0.5f, 0);
    dots.push_back({0, {{from.x(), from.y()}, {to.x(), to.y()}}});
    const Eigen::Vector2f middle = 0.5f * (from + to);
    float nearest = 1e9f;
    for (const Segment& segment : SegmentsOf(drawn))
      nearest = std::min(nearest, (segment.Nearest(middle) - middle).norm());
    sum += 0.5 * nearest, length += 0.5;
  }
  EXPECT_NEAR(DistanceBetween(drawn, dots).projected_to_drawn, sum / length, 1e-3);
}

}  // namespace
}  // namespace daumier::fitting
