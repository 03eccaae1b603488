#include "rig/weights_csv.h"

#include "rig/arkit_names.h"
#include "rig/clip_csv.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(WeightsCsv, IsReadAsAClip) {
  Eigen::MatrixXf weights = Eigen::MatrixXf::Zero(3, kNumArkitNames);
  weights(0, 0) = 1;
  weights(1, 17) = 0.123f;
  weights(2, 51) = 0.5f;
  const std::string text = WeightsCsv(weights, {0, 0.04, 0.08}, {"model: FLAME, 2023; terms: CC BY 4.0", "two\nlines"});
  EXPECT_TRUE(text.starts_with(kWeightsCsvMark));
  const Recording recording = ParseClipCsv(text, "weights.csv");
  EXPECT_TRUE(recording.warnings.empty()) << recording.warnings.front();
  EXPECT_EQ(recording.weights, weights);
  EXPECT_NEAR(recording.seconds[2], 0.08, 1e-9);
}

TEST(WeightsCsv, OfFramesAFewMillisecondsApartKeepsItsUnit) {
  const Recording recording =
      ParseClipCsv(WeightsCsv(Eigen::MatrixXf::Zero(2, kNumArkitNames), {0, 0.004}, {}), "weights.csv");
  EXPECT_NEAR(recording.seconds[1], 0.004, 1e-9);
}

TEST(WeightsCsv, KeepsEveryFrameOfAnEvenRate) {
  std::vector<double> seconds;
  for (int frame = 0; frame < 100; ++frame) seconds.push_back(frame / 60.0);
  const Recording recording =
      ParseClipCsv(WeightsCsv(Eigen::MatrixXf::Zero(100, kNumArkitNames), seconds, {}), "weights.csv");
  EXPECT_EQ(Resample(recording, 60).num_frames(), 100);
}

TEST(WeightsCsv, NeedsATimeAFrame) {
  testing::ExpectError([] { WeightsCsv(Eigen::MatrixXf::Zero(2, kNumArkitNames), {0}, {}); }, "expected N x 52");
  testing::ExpectError([] { WeightsCsv(Eigen::MatrixXf::Zero(0, kNumArkitNames), {}, {}); }, "expected N x 52");
}

}  // namespace
}  // namespace daumier::rig
