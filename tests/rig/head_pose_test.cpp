#include "rig/head_pose.h"

#include "rig/gaze.h"
#include "rig/texture_space.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::rig {
namespace {

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2;

TEST(RotationOf, TurnsToTheLeftAndDownByTheRightHandRule) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE((RotationOf({0, kQuarterTurn, 0}) * forward).isApprox(Eigen::Vector3d::UnitX(), 1e-6));
  EXPECT_TRUE((RotationOf({kQuarterTurn, 0, 0}) * forward).isApprox(-Eigen::Vector3d::UnitY(), 1e-6));
  EXPECT_TRUE((RotationOf({0, 0, kQuarterTurn}) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-6));
  // Pitch and roll first, then yaw.
  EXPECT_TRUE((RotationOf({kQuarterTurn, kQuarterTurn, 0}) * forward).isApprox(-Eigen::Vector3d::UnitY(), 1e-6));
}

TEST(PosableHead, InTheNeutralPoseIsTheJoinedMesh) {
  const RiggedHead head = testing::BallHead();
  const HeadPose neutral = PoseNamed(head.targets.names, {});
  EXPECT_TRUE(PosableHead(head).Vertices(neutral).isApprox(JoinedMesh(head).vertices, 1e-6));
}

TEST(PosableHead, AddsTargetsAndTurnsEyesAboutTheirCentres) {
  const RiggedHead head = testing::BallHead();
  HeadPose pose = PoseNamed(head.targets.names, {{"jawOpen", 0.5f}, {"noSuchTarget", 1.0f}});
  pose.left_eye = {0, kQuarterTurn, 0};
  const geometry::Points vertices = PosableHead(head).Vertices(pose), rest = JoinedMesh(head).vertices;
  const auto jaw = std::find(head.targets.names.begin(), head.targets.names.end(), "jawOpen");
  const Eigen::VectorXd offset = 0.5 * head.targets.offsets.col(jaw - head.targets.names.begin()).cast<double>();
  const Eigen::Index num_skin = head.mesh.vertices.rows(), num_eye = head.eyes[0].mesh.vertices.rows();
  EXPECT_TRUE((vertices - rest)
                  .topRows(num_skin)
                  .isApprox(Eigen::Map<const geometry::Points>(offset.data(), num_skin, 3), 1e-5));
  EXPECT_TRUE(vertices.middleRows(num_skin, num_eye).isApprox(rest.middleRows(num_skin, num_eye), 1e-6));
  const geometry::Points& eye = head.eyes[1].mesh.vertices;
  for (Eigen::Index v = 0; v < eye.rows(); ++v) {  // z turns to x.
    const Eigen::RowVector3d expected =
        Eigen::RowVector3d(eye(v, 2), eye(v, 1), -eye(v, 0)) + head.eyes[1].centre.transpose();
    EXPECT_NEAR((vertices.row(num_skin + num_eye + v) - expected).norm(), 0, 1e-5);
  }
}

TEST(PosableHead, TurnsAllAboutTheHeadsPivot) {
  const RiggedHead head = testing::BallHead();
  HeadPose pose = PoseNamed(head.targets.names, {});
  pose.head = {0, 2 * kQuarterTurn, 0};
  const geometry::Points vertices = PosableHead(head).Vertices(pose), rest = JoinedMesh(head).vertices;
  const Eigen::RowVector3d pivot = head.head_pivot.transpose();
  const Eigen::RowVector3d half_turn(-1, 1, -1);
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    EXPECT_NEAR((vertices.row(v) - pivot - (rest.row(v) - pivot).cwiseProduct(half_turn)).norm(), 0, 1e-5);
}

TEST(PosableHead, IsSharedByThreads) {
  const RiggedHead head = testing::BallHead();
  const PosableHead posable(head);
  const HeadPose pose = PoseNamed(head.targets.names, {{"jawOpen", 1.0f}});
  testing::ExpectTheSameFromThreads(10, [&] { return posable.Vertices(pose); });
}

TEST(PosesOf, SortsWeightsByNameAndTurnsEyesByTheirTargets) {
  WeightsClip clip;
  clip.names = {"eyeLookOutLeft", "jawOpen"};
  clip.weights.resize(2, 2);
  clip.weights << 1, 0.25f, 0, 0.5f;
  const std::vector<std::string> targets = {"jawOpen", "mouthLeft", "eyeLookOutLeft"};
  const std::vector<HeadPose> poses = PosesOf(clip, targets);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].weights, (std::vector<float>{0.25f, 0, 1}));
  EXPECT_EQ(poses[1].weights, (std::vector<float>{0.5f, 0, 0}));
  EXPECT_TRUE(poses[0].left_eye.isApprox(Eigen::Vector3f(0, float(kGazeAngle), 0)));
  EXPECT_TRUE(poses[0].right_eye.isZero());
  testing::ExpectError([&] { PosesOf(clip, {"jawOpen"}); }, "'eyeLookOutLeft'");
}

}  // namespace
}  // namespace daumier::rig
