#include "systems/sketch/train/gesture_training.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "systems/sketch/gesture_run_folder.h"
#include "tests/support/gesture_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class GestureTrainingTest : public testing::GestureRunTest {};

TEST_F(GestureTrainingTest, AFinishedRunResumesToItself) {
  const std::string before = ReadFile(folder() / "run" / "manifest.json");
  EXPECT_EQ(Train("run", true).best_epoch, 1);
  EXPECT_EQ(ReadFile(folder() / "run" / "manifest.json"), before);
}

TEST_F(GestureTrainingTest, EqualTrainingsGiveEqualRuns) {
  Train("again", false);
  EXPECT_EQ(DataHash(folder() / "again"), DataHash(folder() / "run"));
}

TEST_F(GestureTrainingTest, TheThresholdAcceptsItsShareOfValidationGestures) {
  const GestureDecision decision = ReadGestureDecision(folder() / "run");
  EXPECT_GE(decision.rejection.accepted, 0.97);
  EXPECT_GT(decision.rejection.threshold, 0);
  const Manifest manifest = ReadManifest(folder() / "run", "run");
  EXPECT_EQ(manifest.details.at("data").at("gestures"), DataHash(folder() / "gestures"));
  EXPECT_EQ(manifest.counts.at("test_strokes"), 40);
  EXPECT_TRUE(std::filesystem::is_regular_file(folder() / "run" / kBestGraph));
}

}  // namespace
}  // namespace daumier::sketch
