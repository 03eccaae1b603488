#include "systems/sketch/train/ablation.h"

#include "core/config.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"
#include "ablation/ablation.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

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

class SketchAblationTest : public ::testing::Test {
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
        SketchAblation().references());
  }

  static std::unique_ptr<testing::TempDir> folder_;
};

std::unique_ptr<testing::TempDir> SketchAblationTest::folder_;

TEST_F(SketchAblationTest, TrainsAndMeasuresEveryRowAndGoesOnAfterAStop) {
  const SketchAblation task;
  const fs::path out = *folder_ / "out";
  SetInterrupted(true);
  testing::ExpectError([&] { ablation::RunAblation(Load(), task, out); }, "Go on by the same command again");
  SetInterrupted(false);
  EXPECT_EQ(ablation::PlanAblation(Load(), task, out).front().state, ablation::RowState::kToGoOn);

  const Json table = ablation::RunAblation(Load(), task, out);
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
  EXPECT_EQ(ablation::RunAblation(Load(), task, out), table) << "nothing is trained or measured again";
  EXPECT_EQ(fs::last_write_time(out / "random/seed1/pixel/report/metrics.json"), written);
}

TEST_F(SketchAblationTest, RefusesWithoutDataAndUnknownOptionsNamingTheRow) {
  const SketchAblation task;
  testing::ExpectError([&] { task.ResolvedConfig(Json::object(), 1, "person", "row 'a'"); },
                       "row 'a': it needs data.faces=FOLDER");
  testing::ExpectError([&] { task.ResolvedConfig(Json::object(), 1, "persons", "row 'a'"); }, "did you mean 'person'?");
  testing::ExpectError([&] { task.ResolvedEval({{"strenght", 1}}, "row 'a'"); }, "did you mean 'strength'?");
}

TEST(SketchAblationConfigs, AllAreParsed) {
  const SketchAblation task;
  int num_configs = 0;
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs" / "sketch")) {
    if (!LoadConfig(entry.path()).contains("rows")) continue;
    const ablation::Ablation ablation =
        ablation::LoadAblation(entry.path(), {"data.faces=faces", "data.sketches=sketches"}, task.references());
    EXPECT_FALSE(ablation::PlanAblation(ablation, task, "absent").empty()) << entry.path();
    ++num_configs;
  }
  EXPECT_GT(num_configs, 0);
}

TEST(SketchAblationMeasure, ReadsALineByItsNameAndShapeInput) {
  const SketchAblation task;
  const auto line = [](const char* name, const char* input, double error) {
    return Json{{"name", name},
                {"shape_input", input},
                {"error", error},
                {"error_low", 1},
                {"error_high", 3},
                {"p90", 4},
                {"face_errors_mm", {error - 1, error + 1}}};
  };
  const Json metrics = {
      {"table", {line("network", "given", 2), line("network", "recovered", 2.5), line("fit", "none", 6)}},
      {"shape_input", "recovered"},
      {"num_faces", 2},
      {"data_hash", {{"faces", "f"}}},
      {"faces", {3, 5}},
      {"groups", {0, 1}},
      {"regions_mm", {{"nose", 2.0}}}};
  EXPECT_EQ(task.Measure(metrics, "", "").error, 2.5) << "the run's own result";
  EXPECT_EQ(task.Measure(metrics, "", "").face_errors, (std::vector<double>{1.5, 3.5}));
  EXPECT_EQ(task.Measure(metrics, "", "").more.at("p90"), 4);
  EXPECT_EQ(task.Measure(metrics, "", "").more.at("regions_mm").at("nose"), 2.0);
  EXPECT_EQ(task.Measure(metrics, "", "given").error, 2);
  EXPECT_EQ(task.Measure(metrics, "", "given").face_errors, (std::vector<double>{1, 3}));
  EXPECT_TRUE(task.Measure(metrics, "", "given").more.at("regions_mm").is_null()) << "they are the result's";
  EXPECT_EQ(task.Measure(metrics, "fit", "").error, 6);
  EXPECT_EQ(task.Measure(metrics, "fit", "").groups, (std::vector<int>{0, 1}));
  testing::ExpectError([&] { task.Measure(metrics, "ridge", ""); }, "no line 'ridge'");
  Json earlier = metrics;
  for (Json& row : earlier["table"]) row.erase("face_errors_mm");
  testing::ExpectError([&] { task.Measure(earlier, "", ""); }, "delete it, and the same command makes it anew");
  testing::ExpectError([&] { task.Measure(Json::object(), "", ""); }, "malformed");
}

}  // namespace
}  // namespace daumier::sketch
