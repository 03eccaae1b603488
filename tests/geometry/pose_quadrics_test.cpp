#include "geometry/pose_quadrics.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

constexpr float kLanes = 8;

/// A right triangle of legs 3 and 2 in the plane z = 0, and a fourth vertex.
Points TriangleAnd(double x, double y, double z) {
  Points points(4, 3);
  points << 0, 0, 0, 3, 0, 0, 0, 2, 0, x, y, z;
  return points;
}

TEST(PoseQuadrics, ATrianglesCostIsAThirdOfItsAreaTimesTheSquaredDistance) {
  PoseQuadrics quadrics(TriangleAnd(5, -7, 0.5), Eigen::MatrixXf());
  EXPECT_EQ(quadrics.num_poses(), 1);
  quadrics.AddTriangle(0, 1, 2, 4);
  const float expected = 4 * 3.0f / 3 * 0.25f;  // Weight 4, area 3.
  EXPECT_NEAR(quadrics.Cost(0, 3), 2 * expected, 1e-6) << "the mean over the poses, and the worst";
  EXPECT_EQ(quadrics.Cost(0, 1), 0) << "in the plane";
}

TEST(PoseQuadrics, AnEdgesCostIsItsSquaredLengthTimesTheSquaredDistanceFromItsWall) {
  PoseQuadrics quadrics(TriangleAnd(1, -0.5, 0.9), Eigen::MatrixXf());
  quadrics.AddEdge(0, 1, 2, 2);
  EXPECT_NEAR(quadrics.Cost(0, 3), 2 * (2 * 9 * 0.25), 1e-5) << "y alone counts";
  EXPECT_EQ(quadrics.Cost(0, 1), 0);
}

TEST(PoseQuadrics, AddsUpPosesAndTheWorstOfThem) {
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(12, 2);
  offsets(11, 1) = 0.5f;  // In pose 2 the fourth vertex leaves the plane.
  PoseQuadrics quadrics(TriangleAnd(1, 1, 0), offsets);
  quadrics.AddTriangle(0, 1, 2, 1);
  const float of_pose = 3.0f / 3 * 0.25f;
  EXPECT_NEAR(quadrics.Cost(0, 3), of_pose / kLanes + of_pose, 1e-6);
}

TEST(PoseQuadrics, MergedQuadricsAreThoseOfBoth) {
  Points points(6, 3);
  points << 0, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 3, 7, 1, 2, 1, 1, 1;
  PoseQuadrics quadrics(points, Eigen::MatrixXf());
  quadrics.AddTriangle(0, 1, 2, 1);  // z = 0, area 3.
  quadrics.AddTriangle(3, 2, 0, 1);  // x = 0, area 3.
  quadrics.Merge(0, 3);              // Now both at 3.
  // From 3, whose own triangle counts once more, to (7, 1, 2): z^2 + 2 x^2, each times 1.
  EXPECT_NEAR(quadrics.Cost(3, 4), 2 * (4 + 2 * 49.0), 1e-3);
  quadrics.Merge(3, 5);
  EXPECT_NEAR(quadrics.Cost(5, 4), 2 * (4 + 2 * 49.0), 1e-3) << "places in between do not matter";
}

TEST(PoseQuadrics, RefusesTrianglesThatTurnInAnyPose) {
  Points points(5, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, 0, 1.5, 1.5, 0;
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(15, 1);
  const auto may_move = [&](int to) { return PoseQuadrics(points, offsets).MayMove(0, to, 1, 2); };
  EXPECT_TRUE(may_move(3));
  EXPECT_FALSE(may_move(4)) << "beyond the edge 1-2";
  offsets(3 * 3, 0) = offsets(3 * 3 + 1, 0) = 2;
  EXPECT_FALSE(may_move(3)) << "in pose 1 alone";
}

TEST(PoseQuadrics, RefusesSlivers) {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.49, 0.49, 0;
  EXPECT_FALSE(PoseQuadrics(points, Eigen::MatrixXf()).MayMove(0, 3, 1, 2));
}

TEST(PoseQuadrics, RefusesSizesThatDisagree) {
  testing::ExpectError([] { PoseQuadrics(Points::Zero(2, 3), Eigen::MatrixXf::Zero(5, 1)); },
                       "5 offsets for 2 vertices, expected 6");
}

}  // namespace
}  // namespace daumier::geometry
