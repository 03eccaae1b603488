#include "rig/gaze.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <numbers>

namespace daumier::rig {
namespace {

WeightsClip GazeClip() {
  WeightsClip clip;
  clip.names = {"eyeLookOutLeft", "eyeLookInRight", "eyeLookUpLeft", "eyeLookDownRight"};
  clip.weights.resize(2, 4);
  clip.weights << 0, 0, 0, 0, 1, 0.5f, 1, 0.5f;
  return clip;
}

TEST(EyeTurns, TurnsThirtyDegreesAtWeightOneTowardsWhereTheNameSays) {
  const float degree = std::numbers::pi_v<float> / 180;
  const Eigen::MatrixXf left = EyeTurns(GazeClip(), EyeSide::kLeft), right = EyeTurns(GazeClip(), EyeSide::kRight);
  EXPECT_TRUE(left.row(0).isZero() && right.row(0).isZero());
  // Out of the left eye and in of the right one are both to the head's own left: a positive turn about y. Down is a
  // positive turn about x.
  EXPECT_TRUE(left.row(1).isApprox(Eigen::RowVector3f(-30 * degree, 30 * degree, 0), 1e-6f)) << left.row(1);
  EXPECT_TRUE(right.row(1).isApprox(Eigen::RowVector3f(15 * degree, 15 * degree, 0), 1e-6f)) << right.row(1);
}

TEST(EyeTurns, AreThoseOfTheClipWhereItHasThem) {
  WeightsClip clip = GazeClip();
  clip.left_eye = Eigen::MatrixXf::Constant(2, 3, 0.25f);
  EXPECT_EQ(EyeTurns(clip, EyeSide::kLeft), clip.left_eye);
  EXPECT_GT(EyeTurns(clip, EyeSide::kRight)(1, 1), 0.2f) << "the other eye has none";
  clip.left_eye = Eigen::MatrixXf::Zero(3, 3);
  testing::ExpectError([&] { EyeTurns(clip, EyeSide::kLeft); }, "3 x 3 values, expected 2 x 3");
}

}  // namespace
}  // namespace daumier::rig
