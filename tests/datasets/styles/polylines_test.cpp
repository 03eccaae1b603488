#include "datasets/styles/polylines.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

const Polyline kCorner = {{0, 0}, {3, 0}, {3, 4}};
const Polyline kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(Polylines, LengthsAndPlacesAlongALine) {
  EXPECT_EQ(LengthOf(kCorner), 7);
  EXPECT_EQ(ArcLengths(kCorner), (std::vector<double>{0, 3, 7}));
  EXPECT_TRUE(AtShare(kCorner, 3.0 / 7).isApprox(Vector2d(3, 0)));
  EXPECT_TRUE(AtShare(kCorner, 5.0 / 7).isApprox(Vector2d(3, 2)));
  EXPECT_NEAR(ShareNearest(kCorner, {5, 2}), 5.0 / 7, 1e-12);
  EXPECT_EQ(NearestIndex(kCorner, {4, 1}), 1);
  EXPECT_NEAR(DistanceTo(kCorner, {1, -2}), 2, 1e-12);
}

TEST(Polylines, PartsHaveEqualSteps) {
  const Polyline part = Part(kCorner, 1, 0, 8);
  ASSERT_EQ(part.size(), 8u);
  EXPECT_TRUE(part.front().isApprox(Vector2d(3, 4)));
  for (size_t i = 1; i < part.size(); ++i) EXPECT_NEAR((part[i] - part[i - 1]).norm(), 1, 1e-12);
  EXPECT_EQ(Part({{2, 2}}, 0, 1, 3), (Polyline{{2, 2}, {2, 2}, {2, 2}}));
  testing::ExpectError([] { Part({}, 0, 1, 3); }, "3 points of a line of 0");
}

TEST(Polylines, SmoothCurvesPassThroughTheirPoints) {
  const Polyline through = {{0, 0}, {10, 5}, {20, -5}, {30, 0}};
  const Polyline curve = Smooth(through, 200);
  for (const Vector2d& point : through) EXPECT_LT(DistanceTo(curve, point), 0.05);
  EXPECT_EQ(curve.size(), 200u);
}

TEST(Polylines, PiecesOutsideAndInsideMakeTheWhole) {
  const Polyline line = {{-5, 5}, {2, 5}, {4, 20}, {6, 5}, {15, 5}};
  const auto outside = Outside(line, kSquare), inside = Inside(line, kSquare);
  double length = 0;
  for (const auto& pieces : {outside, inside})
    for (const LinePiece& piece : pieces) {
      length += LengthOf(piece.points);
      ASSERT_EQ(piece.origin.size(), piece.points.size());
      for (size_t i = 0; i < piece.origin.size(); ++i)
        if (piece.origin[i] >= 0) {
          EXPECT_EQ(piece.points[i], line[size_t(piece.origin[i])]);
        }
    }
  EXPECT_NEAR(length, LengthOf(line), 1e-9);
  ASSERT_EQ(outside.size(), 3u);
  EXPECT_EQ(outside[0].points.back(), Vector2d(0, 5));
  EXPECT_EQ(outside[0].origin, (std::vector<int>{0, -1}));
  EXPECT_EQ(inside.size(), 2u);
  EXPECT_EQ(Outside({{20, 20}, {30, 20}}, kSquare).size(), 1u);
  EXPECT_TRUE(Inside({{20, 20}, {30, 20}}, kSquare).empty());
}

TEST(Polylines, MixedIsLinearAndRefusesOtherSizes) {
  EXPECT_EQ(Mixed({{0, 0}, {2, 0}}, {{0, 4}, {2, 8}}, 0.25), (Polyline{{0, 1}, {2, 2}}));
  testing::ExpectError([] { Mixed(kCorner, kSquare, 0.5); }, "lines of 3 and 4 points");
}

TEST(Polylines, WavesKeepTheirAmplitude) {
  const Polyline straight = Resampled({{0, 0}, {100, 0}}, 401), waved = Waved(straight, 3, 2, 0);
  double most = 0;
  for (const Vector2d& point : waved) most = std::max(most, std::abs(point.y()));
  EXPECT_NEAR(most, 3, 0.01);
  EXPECT_NEAR(waved.front().y(), 0, 1e-12);
}

TEST(Polylines, DeviationsAreCutOff) {
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) EXPECT_LE(std::abs(Deviate(1.5, rng)), 3.0);
}

}  // namespace
}  // namespace daumier::datasets
