#include "systems/portrait/train/landmark_training.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "tests/support/landmark_run.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

class LandmarkTrainingTest : public testing::LandmarkRunTest {};

TEST_F(LandmarkTrainingTest, AFinishedRunResumesToItself) {
  const std::string before = ReadFile(BestWeights(folder() / "run"));
  EXPECT_EQ(Train("run", true).best_epoch, 1);
  EXPECT_EQ(ReadFile(BestWeights(folder() / "run")), before);
}

TEST_F(LandmarkTrainingTest, EqualTrainingsGiveEqualWeights) {
  Train("again", false);
  EXPECT_EQ(Sha256OfFile(BestWeights(folder() / "again")), Sha256OfFile(BestWeights(folder() / "run")));
}

}  // namespace
}  // namespace daumier::portrait
