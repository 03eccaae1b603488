#include "rig/recording.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

Recording UnevenRecording() {
  Recording recording{.seconds = {0, 0.1, 0.4}, .names = {"a", "b"}};
  recording.weights.resize(3, 2);
  recording.weights << 0, 1, 1, 1, 0.4f, 0;
  recording.head = Eigen::MatrixXf::Zero(3, 3);
  recording.head(1, 1) = 0.2f;
  return recording;
}

TEST(Resample, IsLinearInTimeBetweenFrames) {
  const WeightsClip clip = Resample(UnevenRecording(), 20);
  ASSERT_EQ(clip.num_frames(), 9);
  EXPECT_EQ(clip.frames_per_second, 20);
  EXPECT_EQ(clip.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(clip.weights(1, 0), 0.5, 1e-6);
  EXPECT_NEAR(clip.weights(4, 0), 0.8, 1e-6);  // A third of the way from 1 to 0.4.
  EXPECT_NEAR(clip.weights(4, 1), 2.0 / 3, 1e-6);
  EXPECT_NEAR(clip.head(1, 1), 0.1, 1e-6);
  EXPECT_EQ(clip.left_eye.rows(), 0);
}

TEST(Resample, IsExactAtRecordedTimes) {
  const Recording recording = UnevenRecording();
  const WeightsClip clip = Resample(recording, 10);
  ASSERT_EQ(clip.num_frames(), 5);
  EXPECT_TRUE(clip.weights.row(0).isApprox(recording.weights.row(0), 1e-6f));
  EXPECT_TRUE(clip.weights.row(1).isApprox(recording.weights.row(1), 1e-6f));
  EXPECT_TRUE(clip.weights.row(4).isApprox(recording.weights.row(2), 1e-6f));
}

TEST(Resample, KeepsEvenFramesOfDecimalTimes) {
  Recording recording{.names = {"a"}};
  recording.weights.resize(61, 1);
  for (int i = 0; i < 61; ++i) {
    recording.seconds.push_back(std::round(i / 60.0 * 1e9) / 1e9);
    recording.weights(i, 0) = i % 2 == 0 ? 0.0f : 1.0f;
  }
  const WeightsClip clip = Resample(recording, 60);
  ASSERT_EQ(clip.num_frames(), 61);
  EXPECT_NEAR((clip.weights - recording.weights).cwiseAbs().maxCoeff(), 0, 1e-5);
}

TEST(Resample, OfOneFrameIsThatFrame) {
  Recording recording{.seconds = {0}, .names = {"a"}};
  recording.weights = Eigen::MatrixXf::Constant(1, 1, 0.5f);
  EXPECT_EQ(Resample(recording, 60).weights, recording.weights);
}

TEST(Resample, RefusesNoFramesNoRateAndHours) {
  testing::ExpectError([] { Resample({}, 60); }, "0 frames");
  testing::ExpectError([] { Resample(UnevenRecording(), 0); }, "0 frames a second");
  Recording recording = UnevenRecording();
  recording.seconds[2] = 1e9;
  testing::ExpectError([&] { Resample(recording, 60); }, "lasts 1000000000 s");
}

}  // namespace
}  // namespace daumier::rig
