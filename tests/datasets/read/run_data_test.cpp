#include "datasets/read/run_data.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

/// The manifest and config of a run on six synthetic persons.
class RunDataTest : public ::testing::Test {
 protected:
  RunDataTest() {
    testing::BuildSyntheticFaces(folder_ / "faces");
    const faces::FaceDatabase faces(folder_ / "faces");
    config_ = {{"data", {{"faces", (folder_ / "faces").string()}}}, {"split", ToJson(SplitOptions())}};
    manifest_ = ManifestOfTraining(config_, 7, faces, MakeSplit(faces, SplitOptions(), 7));
    manifest_.details["data"] = {{"faces", DataHash(folder_ / "faces")}};
  }

  const testing::TempDir folder_;
  const std::filesystem::path run_ = folder_ / "run";
  Manifest manifest_;
  Json config_;
};

TEST_F(RunDataTest, AManifestHoldsCountsAndSplitAndNoPath) {
  const faces::FaceDatabase faces(folder_ / "faces");
  EXPECT_EQ(manifest_.kind, "run");
  EXPECT_FALSE(manifest_.config.contains("data"));
  const auto& counts = manifest_.counts;
  EXPECT_EQ(counts.at("training_faces").get<int>() + counts.at("validation_faces").get<int>() +
                counts.at("test_faces").get<int>(),
            faces.num_faces());
  EXPECT_EQ(manifest_.sources, faces.manifest().sources);
}

TEST_F(RunDataTest, RefusesFacesThatTheRunWasNotTrainedOn) {
  EXPECT_EQ(FindRunData(run_, manifest_, config_, "faces"), folder_ / "faces");
  testing::BuildSyntheticFaces(folder_ / "others", 2);
  config_["data"]["faces"] = (folder_ / "others").string();
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "faces"); },
                       "the faces differ from the training data of");
  EXPECT_EQ(FindRunData(run_, manifest_, config_, "faces", folder_ / "faces"), folder_ / "faces");
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "faces", folder_ / "absent"); },
                       "absent does not exist (expected a folder of faces)");
}

TEST_F(RunDataTest, AnEntryMayHaveAnotherNameThanTheKindOfItsFolder) {
  config_["data"]["others"] = config_["data"]["faces"];
  manifest_.details["data"]["others"] = manifest_.details["data"]["faces"];
  EXPECT_EQ(FindRunData(run_, manifest_, config_, "others", "", "faces"), folder_ / "faces");
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "others"); }, "expected a folder of others");
}

TEST_F(RunDataTest, FacesThatMovedAreNamedOrFound) {
  const auto move = [&](const std::filesystem::path& to) {
    std::filesystem::create_directories(to.parent_path());
    std::filesystem::rename(folder_ / "faces", to);
  };
  move(folder_ / "elsewhere/of/mine");
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "faces"); },
                       "If they have moved, add data.faces=FOLDER");
  EXPECT_EQ(FindRunData(run_, manifest_, config_, "faces", folder_ / "elsewhere/of/mine"),
            folder_ / "elsewhere/of/mine");
}

/// /old/project/{data/faces, runs/a} became FOLDER/new/{data/faces, runs/a}.
TEST_F(RunDataTest, DataThatMovedTogetherWithTheRunAreFound) {
  const std::filesystem::path project = std::filesystem::weakly_canonical(folder_.path()) / "new";
  config_["data"]["faces"] = "/old/project/data/faces";
  MakeDirectory(project / "data");
  MakeDirectory(project / "runs/a");
  std::filesystem::rename(folder_ / "faces", project / "data/faces");
  EXPECT_EQ(FindRunData(project / "runs/a", manifest_, config_, "faces"), project / "data/faces");
  testing::BuildSyntheticFaces(project / "runs/data/faces", 2);  // Nearer, but other faces.
  EXPECT_EQ(FindRunData(project / "runs/a", manifest_, config_, "faces"), project / "data/faces");
}

TEST_F(RunDataTest, AConfigWithoutThatDataIsNamed) {
  config_["data"] = {{"points", "x"}};
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "faces"); }, "resolved.toml has no data.faces");
  manifest_.details["data"] = 3;
  testing::ExpectError([&] { FindRunData(run_, manifest_, config_, "faces"); }, "manifest.json has no data.faces");
}

TEST_F(RunDataTest, SplitIsThatOfTheTrainingOrAnError) {
  const faces::FaceDatabase faces(folder_ / "faces");
  const Split split = SplitOfRun(run_, manifest_, config_, faces);
  EXPECT_EQ(SplitToJson(faces, split), manifest_.details.at("split"));
  config_["split"]["test"] = 0.5;
  testing::ExpectError([&] { SplitOfRun(run_, manifest_, config_, faces); }, "split does not match the run's manifest");
}

TEST_F(RunDataTest, ASplitHasThreeSides) {
  const Split split{{1}, {2}, {3}};
  EXPECT_EQ(SubsetOf(split, "train"), std::vector<int>{1});
  EXPECT_EQ(SubsetOf(split, "validation"), std::vector<int>{2});
  EXPECT_EQ(SubsetOf(split, "test"), std::vector<int>{3});
  EXPECT_THROW(SubsetOf(split, "left"), UsageError);
}

}  // namespace
}  // namespace daumier::datasets
