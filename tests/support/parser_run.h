#pragma once
#include "systems/sketch/train/parser_training.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

namespace daumier::testing {

/// A parser's run of one epoch on five synthetic persons, in folder() / "run"; data are in "faces" and "sketches".
class ParserRunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempDir>();
    BuildSyntheticFaces(*folder_ / "faces", 5);
    BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
    Train("run", false);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static const TempDir& folder() { return *folder_; }
  static TrainingSummary Train(const std::string& name, bool resume) {
    const Json config = {
        {"system", "drawing_parser"},
        {"data", {{"faces", (*folder_ / "faces").string()}, {"sketches", (*folder_ / "sketches").string()}}},
        {"network", {{"resolution", 64}, {"width", 16}, {"point_width", 16}}},
        {"split", {{"validation", 0.2}, {"test", 0.2}}},
        {"epochs", 1},
        {"batch", 4}};
    FolderCache databases;
    return sketch::TrainParser(config, {*folder_ / name, resume, {}}, databases, {});
  }

 private:
  static inline std::unique_ptr<TempDir> folder_;
};

}  // namespace daumier::testing
