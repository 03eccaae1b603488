#include "rig/ball_clearance.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(KeepOutsideBall, MovesLidsOutAlongRaysOnTheirWay) {
  HeadSurface head;
  head.mesh.vertices.resize(3, 3);
  head.mesh.vertices << 0, 1.1, 0, 0, 1.1, 0, 0, 0.5, 0;  // A place of the lid, one of no side, one inside the ball.
  const std::vector<FaceSide> sides = {FaceSide::kLeftUpperLid, FaceSide::kNone, FaceSide::kLeftUpperLid};
  Eigen::MatrixXf offsets(9, 2);
  offsets.col(0) << 0, -0.2f, 0, 0, -0.2f, 0, 0, -0.2f, 0;
  offsets.col(1) << 0, 0.2f, 0, 0, 0, 0, 0, 0, 0;
  const Eigen::MatrixXf before = offsets;
  KeepOutsideBall({geometry::Vector3::Zero(), 1}, FaceSlit::kLeftEye, head, sides, offsets);
  EXPECT_NEAR(offsets(1, 0), -0.09f, 1e-6f) << "to 1.01 radii";
  EXPECT_EQ(offsets.bottomRows(6), before.bottomRows(6));
  EXPECT_EQ(offsets.col(1), before.col(1)) << "away from the ball";
}

/// A straight way between two places in front of a ball passes through it.
TEST(KeepOutsideBall, KeepsTheMiddleOfAWayOutside) {
  HeadSurface head;
  head.mesh.vertices.resize(1, 3);
  head.mesh.vertices << 0, 0.8, 0.8;
  Eigen::MatrixXf offsets(3, 1);
  offsets << 0, -1.6f, 0;
  KeepOutsideBall({geometry::Vector3::Zero(), 1}, FaceSlit::kRightEye, head, {FaceSide::kRightUpperLid}, offsets);
  const Eigen::RowVector3d middle = head.mesh.vertices.row(0) + 0.5 * offsets.col(0).transpose().cast<double>();
  EXPECT_GE(middle.norm(), 1.01 - 1e-6);
}

}  // namespace
}  // namespace daumier::rig
