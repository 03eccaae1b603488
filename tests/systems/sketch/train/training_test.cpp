#include "systems/sketch/train/training.h"
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/task.h"
#include "systems/sketch/options.h"
#include "systems/sketch/parser_options.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/train/run.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

TrainingSummary RunSketch(const Json& config, const systems::RunPlace& place, const Task& task) {
  FolderCache databases;
  return TrainSketch(config, place, databases, task);
}

class SketchTrainingTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static Json Config() {
    return {{"data", {{"faces", (*folder_ / "faces").string()}, {"sketches", (*folder_ / "sketches").string()}}},
            {"bilinear", {{"num_identity", 5}, {"num_expression", 3}}},
            {"network", {{"resolution", 32}, {"width", 8}, {"hidden", 32}}},
            {"optimiser", {{"learning_rate", 0.005}}},
            {"epochs", 4},
            {"batch", 8}};
  }
  fs::path Run(const std::string& name) const { return *folder_ / name; }

  static std::unique_ptr<testing::TempDir> folder_;
};

std::unique_ptr<testing::TempDir> SketchTrainingTest::folder_;

TEST_F(SketchTrainingTest, LeavesARunThatIsReadBackAndHasLearnt) {
  Json config = Config();
  config["epochs"] = 15;
  const TrainingSummary summary = RunSketch(config, {Run("learns"), false}, {});
  const SketchRun run = LoadSketchRun(Run("learns"));
  EXPECT_EQ(run.manifest.counts.at("best_epoch"), summary.best_epoch);
  EXPECT_EQ(run.config.at("data").at("faces"), (*folder_ / "faces").string());
  EXPECT_EQ(run.models.gaussian.num_coordinates(), run.models.bilinear.num_coordinates());
  EXPECT_GT(run.models.gaussian.size(), 0);
  std::istringstream log(ReadFile(Run("learns") / "metrics.jsonl"));
  std::vector<double> losses;
  for (std::string line; std::getline(log, line);) {
    const Json entry = Json::parse(line);
    if (entry.at("phase") == "train") losses.push_back(entry.at("loss").get<double>());
  }
  EXPECT_LT(losses.back(), 0.3 * losses.front());
}

TEST_F(SketchTrainingTest, ManifestProvesThatOnlyTrainingFacesWereFittedAndHoldsNoPath) {
  RunSketch(Config(), {Run("proof"), false}, {});
  const Manifest manifest = ReadManifest(Run("proof"), "run");
  const Json& split = manifest.details.at("split");
  EXPECT_EQ(manifest.details.at("bilinear").at("faces_checksum"), split.at("train").at("faces_checksum"));
  EXPECT_EQ(manifest.details.at("bilinear").at("persons"), split.at("train").at("persons"));
  for (const char* side : {"validation", "test"}) {
    for (const Json& person : split.at(side).at("persons"))
      EXPECT_EQ(std::count(split["train"]["persons"].begin(), split["train"]["persons"].end(), person), 0);
  }
  EXPECT_EQ(manifest.details.at("data").at("faces"), DataHash(*folder_ / "faces"));
  EXPECT_EQ(manifest.sources, ReadManifest(*folder_ / "faces", "faces").sources);
  EXPECT_EQ(ReadFile(Run("proof") / "manifest.json").find(folder_->path().string()), std::string::npos);
  VerifyChecksums(Run("proof"), manifest);
}

TEST_F(SketchTrainingTest, ResumedEqualsUninterruptedByteForByte) {
  for (const double strength : {0.0, 1.0}) {
    Json config = Config();
    config["sketch"] = {{"augmentation", {{"strength", strength}}}};
    const fs::path whole = Run(fmt::format("whole{}", strength)), stopped = Run(fmt::format("stopped{}", strength));
    RunSketch(config, {whole, false}, {});
    // Interrupted after the first step, then after the second, then resumed to the end.
    std::stop_source stop;
    const Task cancelled(stop.get_token());
    const Task cancelled_by_training(stop.get_token(), [&](const TaskProgress& progress) {
      if (progress.unit == "steps") stop.request_stop();
    });
    testing::ExpectError(
        [&] {
          RunSketch(config, {stopped, false}, cancelled_by_training);
        },
        "interrupted at step 1 of");
    testing::ExpectError([&] { RunSketch(config, {stopped, true}, cancelled); }, "interrupted at step 2 of");
    RunSketch(config, {stopped, true}, {});
    for (const auto& entry : fs::recursive_directory_iterator(whole)) {
      const fs::path name = fs::relative(entry.path(), whole);
      const bool has_a_clock = name == "metrics.jsonl" || name.filename() == "time.json" ||
                               name.string().find("tfevents") != std::string::npos;
      if (!entry.is_regular_file() || has_a_clock) continue;
      EXPECT_EQ(Sha256OfFile(stopped / name), Sha256OfFile(entry.path())) << name << " with strength " << strength;
    }
  }
}

TEST_F(SketchTrainingTest, RefusesToResumeAnotherConfigAndToOverwriteARun) {
  RunSketch(Config(), {Run("once"), false}, {});
  testing::ExpectError([&] { RunSketch(Config(), {Run("once"), false}, {}); }, "already holds a run");
  Json config = Config();
  config["optimiser"]["learning_rate"] = 0.25;
  testing::ExpectError(
      [&] {
        RunSketch(config, {Run("once"), true}, {});
      },
      "optimiser.learning_rate is 0.005 there and 0.25 now");
}

TEST_F(SketchTrainingTest, AFinishedRunTrainsLongerAsAStageOnRecord) {
  Json config = Config();
  config["epochs"] = 2;
  const fs::path whole = Run("longer"), stopped = Run("longer_stopped");
  for (const fs::path& run : {whole, stopped}) RunSketch(config, {run, false}, {});
  const std::string finished = ReadFile(whole / "best/model.safetensors");
  config["epochs"] = 4;
  EXPECT_EQ(RunSketch(config, {whole, true}, {}).epochs, 4);
  const Manifest manifest = ReadManifest(whole, "run");
  EXPECT_EQ(manifest.config.at("epochs"), 4);
  EXPECT_EQ(manifest.counts.at("epochs"), 4);
  EXPECT_EQ(manifest.details.at("earlier_trainings"), Json({{{"planned_epochs", 2}, {"epochs", 2}}}));
  EXPECT_NO_THROW(VerifyChecksums(whole, manifest));
  EXPECT_NE(ReadFile(whole / "checkpoints/latest/model.safetensors"), finished);
  EXPECT_NO_THROW(LoadSketchRun(whole));

  std::stop_source stop;
  stop.request_stop();
  testing::ExpectError([&] { RunSketch(config, {stopped, true}, Task(stop.get_token())); }, "interrupted at step");
  EXPECT_NO_THROW(LoadSketchRun(stopped)) << "its best weights until now";
  RunSketch(LoadConfig(stopped / "resolved.toml"), {stopped, true}, {});
  for (const char* file : {"best/model.safetensors", "best/model.onnx", "checkpoints/latest/model.safetensors",
                           "checkpoints/latest/state.json", "manifest.json", "resolved.toml"})
    EXPECT_EQ(Sha256OfFile(stopped / file), Sha256OfFile(whole / file)) << file;

  config["epochs"] = 3;
  testing::ExpectError([&] { RunSketch(config, {whole, true}, {}); }, "Resume it with epochs=4");
}

TEST_F(SketchTrainingTest, OptionsThatTheFitRefusesCanBeCorrectedInTheSameFolder) {
  Json config = Config();
  config["bilinear"]["num_identity"] = 500;
  testing::ExpectError([&] { RunSketch(config, {Run("refused"), false}, {}); }, "");
  EXPECT_NO_THROW(RunSketch(Config(), {Run("refused"), false}, {}));
}

TEST_F(SketchTrainingTest, RefusesAWidthWithNarrowLayersBeforeItMakesAFolder) {
  Json config = Config();
  config["network"]["width"] = 12;
  testing::ExpectError([&] { RunSketch(config, {Run("narrow"), false}, {}); }, "set network.width=8 or 16");
  EXPECT_FALSE(fs::exists(Run("narrow")));
}

TEST_F(SketchTrainingTest, RefusesMissingFoldersAndSketchesOfOtherFaces) {
  Json config = Config();
  config["data"].erase("sketches");
  testing::ExpectError([&] { RunSketch(config, {Run("missing"), false}, {}); }, "data.sketches=FOLDER");
  testing::BuildSyntheticFaces(*folder_ / "other_faces", 7);
  testing::BuildSyntheticSketches(*folder_ / "other_faces", *folder_ / "other_sketches");
  config["data"]["sketches"] = (*folder_ / "other_sketches").string();
  testing::ExpectError([&] { RunSketch(config, {Run("missing"), false}, {}); }, "are sketches of other faces");
  EXPECT_FALSE(fs::exists(Run("missing")));
}

TEST(SketchConfigs, AllAreParsed) {
  int num_configs = 0;
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs" / "sketch")) {
    const Json config = LoadConfig(entry.path());
    if (config.contains("rows")) continue;  // tests/train/sketch_ablation_test.cpp
    if (config.value("system", std::string(kSystem)) == kParserSystem) {
      EXPECT_NO_THROW(ParseOptions<ParserTrainingOptions>(config, entry.path().string()));
    } else {
      EXPECT_NO_THROW(ParseOptions<SketchTrainingOptions>(config, entry.path().string()));
    }
    ++num_configs;
  }
  EXPECT_GT(num_configs, 0);
}

}  // namespace
}  // namespace daumier::sketch
