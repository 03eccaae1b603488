#include "render/contour_chains.h"

#include "tests/geometry/shapes.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::render {
namespace {

ContourEnd End(double x, std::array<int, 2> edge = {-1, -1}, double strength = 0) {
  return {Eigen::Vector3d(x, 0, 0), strength, edge};
}

std::vector<double> Xs(const ContourChain& chain) {
  std::vector<double> xs;
  for (Eigen::Index i = 0; i < chain.points.rows(); ++i) xs.push_back(chain.points(i, 0));
  return xs;
}

TEST(ChainContours, SegmentsThatMeetOnAnEdgeBecomeOneChainInTheDirectionOfTheFirst) {
  // 3-4 leads, 1-2 and 2-3 come before it, one of them the wrong way round.
  const std::vector<ContourSegment> segments = {{0, End(3, {5, 6}, 30), End(4, {-1, -1}, 40)},
                                                {1, End(3, {5, 6}, 31), End(2, {2, 3}, 20)},
                                                {2, End(1), End(2, {2, 3}, 21)}};
  const auto chains = ChainContours(segments);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(Xs(chains[0]), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(chains[0].strength[3], 40);
  EXPECT_EQ(chains[0].edges[2], (std::array{5, 6}));
  EXPECT_FALSE(chains[0].closed);
}

TEST(ChainContours, ALoopIsClosedAndRepeatsItsFirstPoint) {
  const std::vector<ContourSegment> segments = {
      {0, End(1, {0, 1}), End(2, {1, 2})}, {1, End(2, {1, 2}), End(3, {0, 2})}, {2, End(3, {0, 2}), End(1, {0, 1})}};
  const auto chains = ChainContours(segments);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(Xs(chains[0]), (std::vector<double>{1, 2, 3, 1}));
}

TEST(ChainContours, AnEdgeWithThreeSegmentsJoinsNone) {
  const std::vector<ContourSegment> segments = {
      {0, End(0), End(1, {7, 8})}, {1, End(1, {7, 8}), End(2)}, {2, End(1, {7, 8}), End(3)}};
  EXPECT_EQ(ChainContours(segments).size(), 3u);
  EXPECT_TRUE(ChainContours({}).empty());
}

TEST(ChainContours, TheContourOfASphereIsOneLoopOfAllItsSegments) {
  const geometry::TriangleMesh sphere = testing::Sphere(2, 4);
  const auto curvatures = geometry::ComputePrincipalCurvatures(sphere);
  const auto camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 20, 10);
  const auto view =
      ComputeViewCurvature(sphere, curvatures, geometry::ComputeCurvatureDerivatives(sphere, curvatures), camera, 0);
  const auto segments = OccludingContours(sphere, view);
  const auto chains = ChainContours(segments);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(chains[0].points.rows(), Eigen::Index(segments.size()) + 1);
  for (Eigen::Index i = 1; i < chains[0].points.rows(); ++i)
    EXPECT_LT((chains[0].points.row(i) - chains[0].points.row(i - 1)).norm(), 0.4) << "no jump";
}

}  // namespace
}  // namespace daumier::render
