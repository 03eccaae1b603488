#include "gltf/head_animation.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::gltf {
namespace {

const std::vector<std::string> kTargets = {"eyeLookOutLeft", "jawOpen"};

rig::WeightsClip ThreeFrames(double first_weight) {
  rig::WeightsClip clip;
  clip.frames_per_second = 10;
  clip.names = {"jawOpen"};
  clip.weights.resize(3, 1);
  clip.weights << float(first_weight), 0.5f, 1;
  return clip;
}

TEST(ResolveClip, NamesAllTargetsInTheHeadsOrder) {
  const HeadAnimation animation = ResolveClip(ThreeFrames(0.25), kTargets);
  EXPECT_EQ(animation.weights.cols(), 2);
  EXPECT_TRUE(animation.weights.col(0).isZero());
  EXPECT_EQ(animation.weights.col(1).tail(3), Eigen::Vector3f(0.25f, 0.5f, 1));
}

TEST(ResolveClip, HoldsTheNeutralPoseFirst) {
  const HeadAnimation animation = ResolveClip(ThreeFrames(0.25), kTargets);
  ASSERT_EQ(animation.times.size(), 5u);
  EXPECT_EQ(animation.times[0], 0);
  EXPECT_FLOAT_EQ(animation.times[1], 0.05f);
  EXPECT_FLOAT_EQ(animation.times[2], 0.1f);
  EXPECT_FLOAT_EQ(animation.times[4], 0.3f);
  EXPECT_DOUBLE_EQ(animation.lead_in_seconds, 0.1);
  EXPECT_TRUE(animation.weights.topRows(2).isZero());
  for (const FloatRows* part : {&animation.head, &animation.right_eye, &animation.left_eye}) {
    ASSERT_EQ(part->rows(), 5);
    EXPECT_EQ(part->row(1), Eigen::RowVector4f(0, 0, 0, 1));
  }
}

TEST(ResolveClip, LeavesAClipAloneThatBeginsNeutral) {
  rig::WeightsClip clip = ThreeFrames(0);
  clip.weights(1, 0) = 0;  // At 0.1 s.
  const HeadAnimation animation = ResolveClip(clip, kTargets);
  EXPECT_EQ(animation.times.size(), 3u);
  EXPECT_EQ(animation.lead_in_seconds, 0);
  EXPECT_EQ(ResolveClip(ThreeFrames(0), kTargets).times.size(), 5u) << "neutral for an instant alone";
  clip.head = Eigen::MatrixXf::Constant(3, 3, 0.1f);
  EXPECT_EQ(ResolveClip(clip, kTargets).times.size(), 5u) << "its weights are neutral, its head is not";
}

TEST(ResolveClip, TurnsByHand) {
  rig::WeightsClip clip = ThreeFrames(0.25);
  const float quarter = float(std::acos(0.0)), half = std::sqrt(0.5f);
  clip.head = Eigen::MatrixXf::Zero(3, 3);
  clip.head(0, 0) = quarter;                // A pitch alone.
  clip.head.row(1) << quarter, quarter, 0;  // R_y R_x: (1, 1, -1, 1) / 2.
  clip.left_eye = Eigen::MatrixXf::Zero(3, 3);
  clip.left_eye(2, 1) = quarter;
  const HeadAnimation animation = ResolveClip(clip, kTargets);
  EXPECT_TRUE(animation.head.row(2).isApprox(Eigen::RowVector4f(half, 0, 0, half), 1e-6f)) << animation.head.row(2);
  EXPECT_TRUE(animation.head.row(3).isApprox(Eigen::RowVector4f(0.5f, 0.5f, -0.5f, 0.5f), 1e-6f));
  EXPECT_TRUE(animation.left_eye.row(4).isApprox(Eigen::RowVector4f(0, half, 0, half), 1e-6f));
}

TEST(ResolveClip, EyesFollowTheirWeightsWhereTheClipDoesNotTurnThem) {
  rig::WeightsClip clip = ThreeFrames(0);
  clip.names = {"eyeLookOutLeft"};
  const HeadAnimation animation = ResolveClip(clip, kTargets);
  // 30 degrees about y: sin 15, cos 15.
  EXPECT_NEAR(animation.left_eye(4, 1), 0.2588190f, 1e-6f);
  EXPECT_NEAR(animation.left_eye(4, 3), 0.9659258f, 1e-6f);
  EXPECT_EQ(animation.right_eye.row(4), Eigen::RowVector4f(0, 0, 0, 1));
}

TEST(ResolveClip, TakesTheShortWayBetweenTurns) {
  rig::WeightsClip clip = ThreeFrames(0);
  clip.head = Eigen::MatrixXf::Zero(3, 3);
  clip.head.col(1) << 0, 3, 3.3f;  // Across 180 degrees.
  const HeadAnimation animation = ResolveClip(clip, kTargets);
  EXPECT_GT(animation.head.row(3).dot(animation.head.row(4)), 0.9f);
}

TEST(ResolveClip, IsEmptyOfAClipWithoutFrames) {
  EXPECT_TRUE(ResolveClip({}, kTargets).times.empty());
}

TEST(ResolveClip, RefusesWhatIsNoClipOfTheHead) {
  const auto expect_error = [](const rig::WeightsClip& clip, const std::string& part) {
    testing::ExpectError([&] { ResolveClip(clip, kTargets); }, part);
  };
  rig::WeightsClip clip = ThreeFrames(0);
  clip.weights(1, 0) = 1.5f;
  expect_error(clip, "frame 1 of the clip has 1.5 for jawOpen, expected 0 .. 1");
  clip.weights(1, 0) = std::numeric_limits<float>::quiet_NaN();
  expect_error(clip, "has nan for jawOpen");
  clip = ThreeFrames(0);
  clip.names = {"jawopen"};
  expect_error(clip, "jawopen, which is no target of this head");
  clip.names = {"jawOpen", "eyeLookOutLeft"};
  expect_error(clip, "2 names and 1 columns");
  clip.weights = Eigen::MatrixXf::Zero(3, 2);
  clip.names = {"jawOpen", "jawOpen"};
  expect_error(clip, "twice");
  clip = ThreeFrames(0);
  clip.frames_per_second = 0;
  expect_error(clip, "0 frames a second");
  clip = ThreeFrames(0);
  clip.head = Eigen::MatrixXf::Zero(2, 3);
  expect_error(clip, "the head in 2 x 3 values, expected 3 x 3");
  clip.head = Eigen::MatrixXf::Constant(3, 3, std::numeric_limits<float>::infinity());
  expect_error(clip, "not finite");
}

}  // namespace
}  // namespace daumier::gltf
