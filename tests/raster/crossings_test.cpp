#include "raster/crossings.h"

#include "raster/rasterise.h"
#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

struct Found {
  Raster<double> raster;
  std::vector<Crossing<double>> crossings;
};

Found FoundIn(const MeshTopology& topology, const std::vector<double>& positions, int side,
              Facing facing = Facing::kBoth, const AntialiasOptions& options = {}) {
  Found found;
  CrossingMemory<double> memory;
  Rasterise(topology, positions.data(), side, side, facing, found.raster);
  FindCrossings(topology, found.raster, facing, options, memory, found.crossings);
  for (const int pair : memory.crossing_of_pair) EXPECT_EQ(pair, -1);
  return found;
}

/// Left of x = at in a picture of 8 x 8; its upper, lower and left sides are outside.
std::vector<double> LeftOf(double at, double depth = 0) {
  return {at, -20, depth, 1, at, 30, depth, 1, -60, 5, depth, 1};
}

const std::vector<int> kOneTriangle = {0, 1, 2};

TEST(FindCrossings, OfAVerticalEdgeAreThoseWorkedOutByHand) {
  const MeshTopology topology = MakeTopology(kOneTriangle, 3);
  for (const double at : {3.3, 3.7}) {
    const Found found = FoundIn(topology, LeftOf(at), 8);
    ASSERT_EQ(found.crossings.size(), 8u);
    for (int row = 0; row < 8; ++row) {
      const Crossing<double>& crossing = found.crossings[row];
      const int left = at < 3.5 ? 2 : 3;
      EXPECT_EQ(crossing.pixel, 8 * row + left);
      EXPECT_EQ(crossing.next, 8 * row + left + 1);
      EXPECT_NEAR(crossing.alpha, 0.5 - (at - left - 0.5), 1e-12);
      EXPECT_NEAR(crossing.share, (row + 0.5 + 20) / 50, 1e-12);
      EXPECT_EQ(crossing.slope, 0);
      EXPECT_FALSE(crossing.is_vertical);
      EXPECT_FALSE(crossing.surface_is_next);
      EXPECT_EQ(crossing.outside(), crossing.next);
    }
  }
}

TEST(FindCrossings, FlatEdgesAreFollowedOverColumns) {
  // Below y = 4.2 + 0.1 x.
  const MeshTopology topology = MakeTopology(kOneTriangle, 3);
  const Found found = FoundIn(topology, {-20, 2.2, 0, 1, 30, 7.2, 0, 1, 5, 90, 0, 1}, 8);
  ASSERT_EQ(found.crossings.size(), 8u);
  for (const Crossing<double>& crossing : found.crossings) {
    EXPECT_TRUE(crossing.is_vertical);
    EXPECT_TRUE(crossing.surface_is_next);
    EXPECT_EQ(crossing.next, crossing.pixel + 8);
    EXPECT_NEAR(crossing.slope, 0.1, 1e-12);
    const double at = 4.2 + 0.1 * (crossing.pixel % 8 + 0.5);
    EXPECT_NEAR(crossing.alpha, 0.5 - (at - crossing.pixel / 8 - 0.5), 1e-12);
  }
}

TEST(FindCrossings, WeightIsThatOfThePointOnTheEdgeInPerspective) {
  const MeshTopology topology = MakeTopology(kOneTriangle, 3);
  std::vector<double> positions = LeftOf(3.3);
  for (int k = 0; k < 4; ++k) positions[4 + k] *= 3;  // The second vertex three times as far away.
  const Found found = FoundIn(topology, positions, 8);
  ASSERT_EQ(found.crossings.size(), 8u);
  for (const Crossing<double>& crossing : found.crossings) {
    const double y = (1 - crossing.weight) * positions[1] + crossing.weight * positions[5];
    const double w = (1 - crossing.weight) * positions[3] + crossing.weight * positions[7];
    EXPECT_NEAR(y / w, crossing.pixel / 8 + 0.5, 1e-12);
  }
}

TEST(FindCrossings, InnerEdgesOfASurfaceHaveNone) {
  // Two triangles that share the edge x = 3.3.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 1, 0, 3}, 4);
  std::vector<double> positions = LeftOf(3.3);
  positions.insert(positions.end(), {60, 5, 0, 1});
  EXPECT_TRUE(FoundIn(topology, positions, 8).crossings.empty());
  positions[12] = -70;  // Folded: the second triangle lies under the first one, at the same side.
  EXPECT_EQ(FoundIn(topology, positions, 8).crossings.size(), 8u);
  EXPECT_EQ(FoundIn(topology, positions, 8, Facing::kFront).crossings.size(), 8u);
}

TEST(FindCrossings, EdgesInFrontOfFartherSurfacesCountAndHiddenOnesDoNot) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 3, 4, 5}, 6);
  std::vector<double> positions = LeftOf(3.3, 10);
  for (const auto& [depth, count] : {std::pair(40.0, 8), std::pair(10.2, 0), std::pair(-40.0, 0)}) {
    std::vector<double> both = positions;
    for (const double number : {-90.0, -90.0, depth, 1.0, 90.0, -90.0, depth, 1.0, 0.0, 200.0, depth, 1.0}) {
      both.push_back(number);
    }
    EXPECT_EQ(FoundIn(topology, both, 8).crossings.size(), size_t(count)) << depth;
  }
}

TEST(FindCrossings, OfSeveralCrossingsBetweenTwoPixelsTheOutermostCounts) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 3, 4, 5}, 6);
  std::vector<double> both = LeftOf(3.6);
  for (const double number : LeftOf(4.1)) both.push_back(number);
  for (int order = 0; order < 2; ++order) {
    const Found found = FoundIn(topology, both, 8);
    ASSERT_EQ(found.crossings.size(), 8u);
    for (const Crossing<double>& crossing : found.crossings) EXPECT_NEAR(crossing.alpha, 0.5 - 0.6, 1e-12);
    std::rotate(both.begin(), both.begin() + 12, both.end());
  }
}

TEST(FindCrossings, AreaIsTheIntegralOfItsFormula) {
  for (const double slope : {0.0, 0.3, -0.8, 1.0}) {
    for (const double alpha : {-0.5, -0.31, 0.0, 0.12, 0.5}) {
      Crossing<double> crossing{.alpha = alpha, .slope = slope};
      double sum = 0, derivative = 0;
      constexpr int kSteps = 100000;
      for (int i = 0; i < kSteps; ++i) {
        const double inside = alpha + slope * ((i + 0.5) / kSteps - 0.5);
        sum += std::max(0.0, inside) / kSteps;
        derivative += inside > 0 ? 1.0 / kSteps : 0;
      }
      EXPECT_NEAR(crossing.Area(alpha), sum, 1e-8);
      EXPECT_NEAR(crossing.Area(alpha) - crossing.Area(-alpha), alpha, 1e-12);
      if (alpha != 0) {
        EXPECT_NEAR(crossing.AreaSlope(), derivative, 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace daumier::raster
