#include "systems/portrait/train/portrait_training.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/given_pictures.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(TrainPortrait, LeavesARunFolderWithItsSplitAndGraph) {
  const std::filesystem::path run = testing::SmallPortraitRun();
  const Manifest manifest = ReadFinishedRun(run, kPortraitSystem);
  EXPECT_EQ(manifest.details.at("split").at("test").at("num_persons"), 1);
  EXPECT_EQ(manifest.counts.at("steps"), 2);  // Two persons of two portraits each, two portraits a batch.
  EXPECT_TRUE(std::filesystem::is_regular_file(run / kBestGraph));
  EXPECT_EQ(ReadFile(run / "manifest.json").find(testing::SmallPortraitFolder().path().string()), std::string::npos);
}

TEST(TrainPortrait, EqualTrainingsGiveEqualWeightsAndAFinishedOneStaysAsItIs) {
  const testing::TempDir folder;
  EXPECT_EQ(testing::TrainSmallPortrait(folder / "run").best_epoch, 1);
  const std::string weights = ReadFile(BestWeights(folder / "run"));
  EXPECT_TRUE(weights == ReadFile(BestWeights(testing::SmallPortraitRun())));
  EXPECT_EQ(testing::TrainSmallPortrait(folder / "run").best_epoch, 1);
  EXPECT_TRUE(weights == ReadFile(BestWeights(folder / "run")));
}

TEST(TrainPortrait, RefusesPortraitsOfOtherFaces) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "others", 7);
  const Json config = testing::SmallPortraitConfig(folder / "others", testing::SmallPortraitFolder() / "portraits");
  FolderCache databases;
  testing::ExpectError([&] { TrainPortrait(config, {folder / "run"}, databases, {}); },
                       "shows other faces than those of");
  EXPECT_FALSE(std::filesystem::exists(folder / "run" / "manifest.json"));
}

TEST(TrainPortrait, RefusesPicturesWithoutKnownFacesAsItsPortraits) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  BuildGivenPortraits(testing::GivenDetector(), {}, folder / "in", {}, folder / "given");
  const Json config = testing::SmallPortraitConfig(testing::SmallPortraitFolder() / "faces", folder / "given");
  FolderCache databases;
  testing::ExpectError([&] { TrainPortrait(config, {folder / "run"}, databases, {}); }, "Name the folder in real");
}

}  // namespace
}  // namespace daumier::portrait
