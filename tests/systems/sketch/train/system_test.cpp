#include "systems/sketch/train/system.h"

#include "ablation/ablation.h"
#include "core/config.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/manifest.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

ablation::AblationSystem System() {
  static const systems::System system = SketchSystem();
  static const systems::SystemTraining training = SketchTraining();
  return {system, training};
}

constexpr const char* kTable = R"(
splits = ["random"]
[config]
bilinear = {num_identity = 5, num_expression = 3}
network = {resolution = 32, width = 8, hidden = 16, branch = 16, shape_hidden = 8}
epochs = 2
batch = 8
[[rows]]
name = "shape"
paper = 2.04
shape_input = "given"
config.network.shape_input = "late"
eval.recover_with = "pixel"
[[rows]]
name = "shape, recovered"
from = "shape"
shape_input = "recovered"
[[rows]]
name = "pixel"
[[rows]]
name = "ridge"
from = "pixel"
line = "ridge regression"
)";

class SketchSystemTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
    WriteFileAtomically(*folder_ / "table.toml", kTable);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ablation::Ablation Load() {
    return ablation::LoadAblation(
        *folder_ / "table.toml",
        {"data.faces=" + (*folder_ / "faces").string(), "data.sketches=" + (*folder_ / "sketches").string()},
        System().system.run_options);
  }

  inline static std::unique_ptr<testing::TempDir> folder_;
};

TEST_F(SketchSystemTest, AnAblationTrainsAndMeasuresEveryRowAndResumes) {
  const fs::path out = *folder_ / "out";
  SetInterrupted(true);
  testing::ExpectError([&] { ablation::RunAblation(Load(), System(), out, {}, Task(InterruptToken())); },
                       "The same command resumes it");
  SetInterrupted(false);
  EXPECT_EQ(ablation::PlanAblation(Load(), System(), out).front().state, ablation::RowState::kToResume);

  const Json table = ablation::RunAblation(Load(), System(), out);
  std::vector<std::string> names;
  for (const Json& row : table) names.push_back(row["name"].get<std::string>());
  EXPECT_EQ(names, (std::vector<std::string>{"mean face", "nearest neighbour", "ridge regression", "limit of the model",
                                             "shape", "shape, recovered", "pixel", "ridge"}));
  const Json &given = table[4], &recovered = table[5], &pixel = table[6];
  for (const Json* row : {&given, &recovered, &pixel})
    for (const char* key :
         {"error", "error_low", "error_high", "steps", "parameters", "train_seconds", "infer_ms", "p90"})
      EXPECT_GT(row->at(key).get<double>(), 0) << key;
  EXPECT_EQ(given["paper"], 2.04);
  EXPECT_EQ(given["shape_input"], "given");
  EXPECT_EQ(recovered["shape_input"], "recovered");
  EXPECT_EQ(recovered["parameters"], given["parameters"]);
  EXPECT_GT(given["parameters"], pixel["parameters"]);
  EXPECT_EQ(pixel["data_hash"]["faces"], DataHash(*folder_ / "faces"));
  EXPECT_TRUE(pixel["regions_mm"].is_object());
  for (const Json& row : table) {
    if (row.at("name") == "shape") continue;
    EXPECT_EQ(row["difference_to"], "shape");
    EXPECT_NEAR(row["difference"].get<double>(), row["error"].get<double>() - given["error"].get<double>(), 1e-9);
  }
  EXPECT_EQ(table[7]["error"], table[2]["error"]);
  EXPECT_TRUE(table[7]["steps"].is_null());
  EXPECT_EQ(ReadManifest(out / "random/seed1/shape/run", "run").config.at("split").at("kind"), "random");
  for (const char* file : {"sheet.png", "curves.svg", "index.html", "table.md"}) EXPECT_TRUE(fs::exists(out / file));

  const auto written = fs::last_write_time(out / "random/seed1/pixel/report/metrics.json");
  EXPECT_EQ(ablation::RunAblation(Load(), System(), out), table) << "nothing is trained or measured again";
  EXPECT_EQ(fs::last_write_time(out / "random/seed1/pixel/report/metrics.json"), written);
}

TEST_F(SketchSystemTest, TrainingAndEvaluationShareDatabases) {
  const std::string where = "test";
  FolderCache databases;
  Json config = Load().rows[2].config;
  config["seed"] = 1;
  config["epochs"] = 1;
  SketchTraining().train(SketchSystem().resolve_config(config, where), {.directory = *folder_ / "shared"}, databases,
                         {});
  const reports::Evaluation evaluation = SketchTraining().evaluate(
      *folder_ / "shared", SketchSystem().resolve_evaluation({{"baselines", false}}, where), databases, {});
  EXPECT_EQ(evaluation.table.rows.size(), 1u);
  EXPECT_EQ(databases.size(), 2u);
}

TEST_F(SketchSystemTest, RefusesWithoutDataAndUnknownOptionsNamingTheRow) {
  testing::ExpectError([] { SketchSystem().resolve_config(Json::object(), "row 'a'"); },
                       "row 'a': it needs data.faces=FOLDER");
  testing::ExpectError(
      [] {
        SketchSystem().resolve_config({{"split", {{"kind", "persons"}}}}, "row 'a'");
      },
      "did you mean 'person'?");
  testing::ExpectError(
      [] {
        SketchSystem().resolve_evaluation({{"strenght", 1}}, "row 'a'");
      },
      "did you mean 'strength'?");
}

TEST(SketchAblationConfigs, AllAreParsedAndOnlyTakesEachRow) {
  int num_configs = 0;
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs" / "sketch")) {
    if (!LoadConfig(entry.path()).contains("rows")) continue;
    const ablation::Ablation ablation = ablation::LoadAblation(
        entry.path(), {"data.faces=faces", "data.sketches=sketches"}, System().system.run_options);
    for (const ablation::AblationRow& row : ablation.rows)
      EXPECT_FALSE(ablation::PlanAblation(ablation, System(), "absent", {row.name()}).empty()) << row.name();
    ++num_configs;
  }
  EXPECT_GT(num_configs, 0);
}

}  // namespace
}  // namespace daumier::sketch
