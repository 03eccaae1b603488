#include "rig/head_parts.h"

#include "tests/support/ball_head.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(FitBall, FindsAnExactSphereAndRefusesOtherShapes) {
  geometry::TriangleMesh ball = testing::UvBall(1.25, 6, 9);
  ball.vertices.rowwise() += Eigen::RowVector3d(3, -2, 7);
  const auto fitted = FitBall(ball.vertices);
  ASSERT_TRUE(fitted);
  EXPECT_NEAR((fitted->centre - geometry::Vector3(3, -2, 7)).norm(), 0, 1e-9);
  EXPECT_NEAR(fitted->radius, 1.25, 1e-9);
  ball.vertices.col(0) *= 2;
  EXPECT_FALSE(FitBall(ball.vertices)) << "an ellipsoid";
  ball.vertices.col(0).setZero();
  EXPECT_FALSE(FitBall(ball.vertices)) << "a disc";
  EXPECT_FALSE(FitBall(ball.vertices.topRows(5)));
}

}  // namespace
}  // namespace daumier::rig
