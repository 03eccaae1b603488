#include "train/run_folder.h"

#include "core/files.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

const Json kConfig = {{"seed", 1}, {"optimiser", {{"learning_rate", 0.001}, {"beta1", 0.9}}}};
const Json kData = {{"faces", "abc"}, {"sketches", "def"}};

void WriteRun(const std::filesystem::path& folder) {
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.config = kConfig;
  manifest.details["data"] = kData;
  WriteManifest(folder, manifest);
}

TEST(WithAbsoluteData, MakesFoldersAbsoluteOrNamesTheMissingOnes) {
  const Json config = {{"epochs", 2}, {"data", {{"faces", "a/../b"}, {"points", "/c"}}}};
  const Json absolute = WithAbsoluteData(config, "row 'a'");
  EXPECT_EQ(absolute["data"]["faces"], (std::filesystem::current_path() / "b").string());
  EXPECT_EQ(absolute["data"]["points"], "/c");
  EXPECT_EQ(absolute["epochs"], 2);
  Json missing = config;
  missing["data"]["points"] = "";
  EXPECT_THROW(WithAbsoluteData(missing, "row 'a'"), UsageError);
  testing::ExpectError([&] { WithAbsoluteData(missing, "row 'a'"); },
                       "row 'a': it needs data.faces=FOLDER and data.points=FOLDER");
}

TEST(WithoutPaths, LeavesOutDataAndFilesOfTheSource) {
  const Json config = {
      {"data", {{"faces", "f"}}}, {"real", "r"}, {"epochs", 3}, {"source", {{"name", "ict"}, {"path", "p"}}}};
  EXPECT_EQ(WithoutPaths(config), (Json{{"epochs", 3}, {"source", {{"name", "ict"}}}}));
  EXPECT_EQ(WithoutPaths(Json{{"epochs", 3}}), (Json{{"epochs", 3}}));
}

TEST(OpenRunFolder, ResumesARunThatIsOlderThanAnOption) {
  const testing::TempDir folder;
  WriteRun(folder.path());
  Json config = kConfig;
  config["precision"] = "float32";
  const Json defaults = {{"precision", "float32"}};
  EXPECT_TRUE(OpenRunFolder(folder.path(), true, config, kData, defaults));
  config["precision"] = "bfloat16";
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, config, kData, defaults); },
                       "precision is \"float32\" there and \"bfloat16\" now");
}

TEST(OpenRunFolder, APrecisionThatTheMachineChoosesIsThatOfTheRun) {
  const testing::TempDir folder;
  WriteRun(folder.path());
  Json config = kConfig;
  config["precision"] = "auto";
  const Json defaults = {{"precision", "float32"}};
  EXPECT_TRUE(OpenRunFolder(folder.path(), true, config, kData, defaults));
  Manifest manifest = ReadManifest(folder.path(), "run");
  manifest.config["precision"] = "bfloat16";
  WriteManifest(folder.path(), manifest);
  for (const char* precision : {"auto", "bfloat16", "force-bfloat16"}) {
    config["precision"] = precision;
    EXPECT_TRUE(OpenRunFolder(folder.path(), true, config, kData, defaults)) << precision;
  }
}

TEST(OpenRunFolder, StartsANewOne) {
  const testing::TempDir folder;
  EXPECT_FALSE(OpenRunFolder(folder / "runs" / "new", false, kConfig, kData));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "runs" / "new"));
}

TEST(OpenRunFolder, RefusesAnExistingRunUnlessItIsResumed) {
  const testing::TempDir folder;
  WriteRun(folder.path());
  testing::ExpectError([&] { OpenRunFolder(folder.path(), false, kConfig, kData); }, "already holds a run");
  EXPECT_TRUE(OpenRunFolder(folder.path(), true, kConfig, kData));
}

TEST(OpenRunFolder, RefusesToResumeWhatIsNotThere) {
  const testing::TempDir folder;
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, kConfig, kData); }, "holds no run");
}

TEST(OpenRunFolder, RefusesAnotherConfigOrOtherDataSayingWhatDiffers) {
  const testing::TempDir folder;
  WriteRun(folder.path());
  Json config = kConfig;
  config["seed"] = 2;
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, config, kData); }, "seed is 1 there and 2 now");
  testing::ExpectError(
      [&] {
        OpenRunFolder(folder.path(), true, kConfig, {{"faces", "abc"}, {"sketches", "xyz"}});
      },
      "data.sketches is \"def\" there and \"xyz\" now");
}

TEST(OpenRunFolder, RestartsWhereARunWasKilledBeforeItsManifest) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "resolved.toml", "seed = 1\n");
  EXPECT_THROW(OpenRunFolder(folder.path(), false, kConfig, kData), UsageError);
  EXPECT_FALSE(OpenRunFolder(folder.path(), true, kConfig, kData));
}

/// A finished run of four epochs.
void WriteFinishedRunOfFour(const std::filesystem::path& folder, Json config) {
  WriteRun(folder);
  MakeDirectory(folder / "best");
  WriteFileAtomically(folder / kBestFile, "weights");
  WriteFileAtomically(folder / kBestGraph, "graph");
  Manifest manifest = ReadManifest(folder, "run");
  manifest.config = std::move(config);
  manifest.checksums[kBestGraph] = Sha256("graph");
  WriteManifest(folder, manifest);
  FinishRun(folder, {.steps = 12, .epochs = 4, .metric = "error", .best_epoch = 2}, 7);
}

Json ConfigOf(int epochs) {
  Json config = kConfig;
  config["epochs"] = epochs;
  return config;
}

TEST(LengthenFinishedRun, RecordsTheTrainingSoFarAndIsNotFinished) {
  const testing::TempDir folder;
  WriteFinishedRunOfFour(folder.path(), ConfigOf(4));
  LengthenFinishedRun(folder.path(), ConfigOf(6), kData, {});
  const Manifest manifest = ReadManifest(folder.path(), "run");
  EXPECT_EQ(manifest.config, ConfigOf(6));
  EXPECT_EQ(manifest.counts, Json::parse(R"({"parameters": 7})"));
  EXPECT_EQ(manifest.checksums.count(kBestFile) + manifest.checksums.count(kBestGraph), 0u);
  EXPECT_FALSE(std::filesystem::exists(folder / kBestGraph));
  EXPECT_TRUE(OpenRunFolder(folder.path(), true, ConfigOf(6), kData));
  const std::vector<EarlierTraining> earlier = EarlierTrainings(folder.path());
  ASSERT_EQ(earlier.size(), 1u);
  EXPECT_EQ(earlier[0].planned_epochs, 4);
  EXPECT_EQ(earlier[0].epochs, 4);
  FinishRun(folder.path(), {.steps = 18, .epochs = 6, .metric = "error", .best_epoch = 5}, 7);
  LengthenFinishedRun(folder.path(), ConfigOf(9), kData, {});
  EXPECT_EQ(EarlierTrainings(folder.path()).size(), 2u);
}

TEST(LengthenFinishedRun, LeavesEveryOtherRunAsItIs) {
  const testing::TempDir folder;
  LengthenFinishedRun(folder / "absent", ConfigOf(6), kData, {});
  WriteFinishedRunOfFour(folder.path(), ConfigOf(4));
  const std::string before = ReadFile(folder / "manifest.json");
  Json other = ConfigOf(6);
  other["seed"] = 2;
  LengthenFinishedRun(folder.path(), other, kData, {});
  LengthenFinishedRun(folder.path(), ConfigOf(6), {{"faces", "other"}}, {});
  LengthenFinishedRun(folder.path(), ConfigOf(4), kData, {});
  LengthenFinishedRun(folder.path(), ConfigOf(3), kData, {});
  EXPECT_EQ(ReadFile(folder / "manifest.json"), before);
  EXPECT_TRUE(EarlierTrainings(folder.path()).empty());
}

TEST(OpenRunFolder, SaysWhatToDoAboutOtherEpochs) {
  const testing::TempDir folder;
  WriteFinishedRunOfFour(folder.path(), ConfigOf(4));
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, ConfigOf(3), kData); }, "Resume it with epochs=4");
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, ConfigOf(8), kData); },
                       "To train the finished run longer: daumier train " + (folder / "resolved.toml").string());
  Manifest manifest = ReadManifest(folder.path(), "run");
  manifest.counts.erase("best_epoch");
  WriteManifest(folder.path(), manifest);
  testing::ExpectError([&] { OpenRunFolder(folder.path(), true, ConfigOf(8), kData); },
                       "Finish it first: daumier train");
}

TEST(OpenRunFolder, RefusesAFolderOfSomethingElse) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "letter.txt", "precious");
  testing::ExpectError([&] { OpenRunFolder(folder.path(), false, kConfig, kData); },
                       "is not empty and holds no earlier run (it has 'letter.txt')");
  Manifest faces{.kind = "faces"};
  WriteManifest(folder.path(), faces);
  for (const bool resume : {false, true})
    testing::ExpectError([&] { OpenRunFolder(folder.path(), resume, kConfig, kData); }, "it is a folder of faces");
}

TEST(FinishRun, SaysHowTheTrainingEndedAndNamesItsWeights) {
  const testing::TempDir folder;
  WriteRun(folder.path());
  MakeDirectory(folder / "best");
  WriteFileAtomically(folder / kBestFile, "weights");
  FinishRun(folder.path(), {.steps = 12, .epochs = 3, .metric = "error", .best_epoch = 2}, 7);
  const Manifest manifest = ReadManifest(folder.path(), "run");
  EXPECT_EQ(manifest.counts, Json::parse(R"({"parameters": 7, "steps": 12, "epochs": 3, "best_epoch": 2})"));
  EXPECT_EQ(manifest.checksums.at(kBestFile), Sha256("weights"));
  EXPECT_EQ(manifest.config, kConfig) << "the existing manifest is unchanged";
}

}  // namespace
}  // namespace daumier::train
