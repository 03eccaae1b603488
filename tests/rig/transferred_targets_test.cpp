#include "rig/transferred_targets.h"

#include "tests/support/ball_head.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// Offsets, 3V x T, of vertices that lie behind z = -2 are 0 in all targets.
RiggedHead BallWithStillBack() {
  RiggedHead head = testing::BallHead(16, 24);
  for (Eigen::Index v = 0; v < head.mesh.vertices.rows(); ++v)
    if (head.mesh.vertices(v, 2) < -2) head.targets.offsets.middleRows<3>(3 * v).setZero();
  return head;
}

TEST(TransferredTargets, OfAnEqualShapeAreEqual) {
  const RiggedHead head = BallWithStillBack();
  const MorphTargets same = TransferredTargets(head.mesh, head.mesh.vertices, head.targets);
  EXPECT_EQ(same.names, head.targets.names);
  EXPECT_EQ(same.offsets, head.targets.offsets);
}

TEST(TransferredTargets, OfAScaledShapeAreScaled) {
  const RiggedHead head = BallWithStillBack();
  const geometry::Points scaled = (1.3 * head.mesh.vertices).rowwise() + Eigen::RowVector3d(1, 2, 3);
  const MorphTargets targets = TransferredTargets(head.mesh, scaled, head.targets);
  EXPECT_LT((targets.offsets - 1.3f * head.targets.offsets).cwiseAbs().maxCoeff(), 0.002f);
}

TEST(TransferredTargets, OfAPartWithoutAStillVertexAreScaled) {
  RiggedHead head = testing::BallHead(8, 10);
  head.targets.offsets.setConstant(0.25f);
  const geometry::Points scaled = 0.5 * head.mesh.vertices;
  const MorphTargets targets = TransferredTargets(head.mesh, scaled, head.targets);
  EXPECT_LT((targets.offsets.array() - 0.125f).abs().maxCoeff(), 1e-6f);
}

TEST(TransferredTargets, ChangeNearAnEditAndHardlyFarFromIt) {
  const RiggedHead head = BallWithStillBack();
  geometry::Points edited = head.mesh.vertices;
  const Eigen::RowVector3d tip(0, 2, 9);
  for (auto vertex : edited.rowwise())
    vertex += std::exp(-(vertex - tip).squaredNorm() / 4) * Eigen::RowVector3d(0, 0, 1);
  const MorphTargets targets = TransferredTargets(head.mesh, edited, head.targets);
  float near = 0, far = 0;
  for (Eigen::Index v = 0; v < edited.rows(); ++v) {
    const float change =
        (targets.offsets.middleRows<3>(3 * v) - head.targets.offsets.middleRows<3>(3 * v)).cwiseAbs().maxCoeff();
    const double distance = (head.mesh.vertices.row(v) - tip).norm();
    if (distance < 5) near = std::max(near, change);
    if (distance > 9) far = std::max(far, change);
  }
  EXPECT_GT(near, 0.02f);
  EXPECT_LT(far, 0.3f * near);
}

TEST(TransferredTargets, WithstandTrianglesWithoutArea) {
  RiggedHead head = BallWithStillBack();
  const auto corners = head.mesh.triangles.row(40);
  const int a = corners[0], b = corners[1];
  // A pose in which two vertices meet, and an edit that does the same elsewhere.
  const geometry::Vector3 meet = (head.mesh.vertices.row(b) - head.mesh.vertices.row(a)).transpose();
  head.targets.offsets.col(3).segment<3>(3 * a) = meet.cast<float>() + head.targets.offsets.col(3).segment<3>(3 * b);
  geometry::Points edited = head.mesh.vertices;
  edited.row(head.mesh.triangles(90, 0)) = edited.row(head.mesh.triangles(90, 1));
  EXPECT_TRUE(TransferredTargets(head.mesh, edited, head.targets).offsets.allFinite());
}

TEST(MeanMotion, IsExactForScalingsAndShifts) {
  const geometry::Points from = testing::UvBall(2, 6, 8).vertices;
  const geometry::Points to = (1.5 * from).rowwise() + Eigen::RowVector3d(1, -2, 3);
  const MeanMotion motion = MeanMotionOf(from, to);
  EXPECT_NEAR(motion.scale, 1.5, 1e-12);
  EXPECT_LT((motion.Apply({4, 5, 6}) - geometry::Vector3(7, 5.5, 12)).norm(), 1e-9);
  EXPECT_EQ(MeanMotionOf(from, from).scale, 1);
  const geometry::Points one = from.topRows(1);
  EXPECT_EQ(MeanMotionOf(one, one).scale, 1) << "a point has no spread";
}

}  // namespace
}  // namespace daumier::rig
