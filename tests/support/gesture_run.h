#pragma once
#include "datasets/build/gestures.h"
#include "systems/sketch/train/gesture_training.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

namespace daumier::testing {

/// A run of gestures of one epoch, in folder() / "run"; its data, of 12 hands, in "gestures".
class GestureRunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempDir>();
    datasets::BuildGestures({.num_hands = 12, .per_gesture = 2, .none = 20}, *folder_ / "gestures");
    Train("run", false);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static const TempDir& folder() { return *folder_; }
  static TrainingSummary Train(const std::string& name, bool resume) {
    const Json config = {{"system", "gestures"},
                         {"data", {{"gestures", (*folder_ / "gestures").string()}}},
                         {"epochs", 1},
                         {"batch", 16}};
    FolderCache databases;
    return sketch::TrainGestures(config, {*folder_ / name, resume, {}}, databases, {});
  }

 private:
  static inline std::unique_ptr<TempDir> folder_;
};

}  // namespace daumier::testing
