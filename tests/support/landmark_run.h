#pragma once
#include "systems/portrait/train/landmark_training.h"
#include "tests/support/drawn_portrait_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace daumier::testing {

/// A run of one epoch on sixteen drawn portraits, in folder() / "run"; the portraits are in folder() / "portraits".
class LandmarkRunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempDir>();
    WriteDrawnPortraits(*folder_ / "portraits", 16);
    Train("run", false);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static const TempDir& folder() { return *folder_; }
  static TrainingSummary Train(const std::string& name, bool resume) {
    const Json config = {{"system", "landmarks"},
                         {"data", {{"portraits", (*folder_ / "portraits").string()}}},
                         {"network", {{"resolution", 64}, {"width", 16}, {"point_width", 16}}},
                         {"split", {{"validation", 0.2}, {"test", 0.2}}},
                         {"epochs", 1},
                         {"batch", 4}};
    FolderCache databases;
    return portrait::TrainLandmarks(config, {*folder_ / name, resume, {}}, databases, {});
  }

 private:
  static inline std::unique_ptr<TempDir> folder_;
};

}  // namespace daumier::testing
