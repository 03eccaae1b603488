#include "systems/portrait/train/landmark_run.h"

#include "core/run_manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/landmark_run.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

class LoadedLandmarkRunTest : public testing::LandmarkRunTest {};

TEST_F(LoadedLandmarkRunTest, LeavesARunFolderWithItsSplitAndGraph) {
  const LandmarkRun run = LoadLandmarkRun(folder() / "run");
  EXPECT_EQ(run.network_options.resolution, 64);
  EXPECT_FALSE(run.network->is_training());
  EXPECT_EQ(run.manifest.details.at("split").at("test").at("num_portraits"), 4);
  EXPECT_TRUE(std::filesystem::is_regular_file(folder() / "run" / kBestGraph));
  testing::ExpectError([&] { ReadLandmarkRunFolder(folder() / "portraits"); }, "portraits");
}

}  // namespace
}  // namespace daumier::portrait
