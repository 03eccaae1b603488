#include "train/sketch_ablation.h"

#include "core/files.h"
#include "core/interrupt.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"
#include "train/ablation.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTable = R"(
splits = ["random"]
[config]
bilinear = {num_identity = 5, num_expression = 3}
network = {resolution = 32, width = 4, hidden = 16}
epochs = 2
batch = 8
[[rows]]
name = "wide"
paper = 2.22
[[rows]]
name = "narrow"
config.network.width = 2
[[rows]]
name = "ridge"
from = "wide"
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

  static Ablation Load() {
    return LoadAblation(
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
  testing::ExpectError([&] { RunAblation(Load(), task, out); }, "Go on by the same command again");
  SetInterrupted(false);
  EXPECT_EQ(PlanAblation(Load(), task, out).front().state, RowState::kToGoOn);

  const Json table = RunAblation(Load(), task, out);
  std::vector<std::string> names;
  for (const Json& row : table) names.push_back(row["name"].get<std::string>());
  EXPECT_EQ(names, (std::vector<std::string>{"mean face", "nearest neighbour", "ridge regression", "limit of the model",
                                             "wide", "narrow", "ridge"}));
  for (const char* key :
       {"error", "error_low", "error_high", "steps", "parameters", "train_seconds", "infer_ms", "p90"})
    EXPECT_GT(table[4].at(key).get<double>(), 0) << key;
  EXPECT_EQ(table[4]["paper"], 2.22);
  EXPECT_EQ(table[4]["shape_input"], "none");
  EXPECT_EQ(table[4]["data_hash"]["faces"], DataHash(*folder_ / "faces"));
  EXPECT_GT(table[4]["parameters"], table[5]["parameters"]);
  EXPECT_EQ(table[6]["error"], table[2]["error"]);
  EXPECT_TRUE(table[6]["steps"].is_null());
  EXPECT_EQ(ReadManifest(out / "random/seed1/narrow/run", "run").config.at("split").at("kind"), "random");

  const auto written = fs::last_write_time(out / "random/seed1/wide/report/metrics.json");
  EXPECT_EQ(RunAblation(Load(), task, out), table) << "nothing is trained or measured again";
  EXPECT_EQ(fs::last_write_time(out / "random/seed1/wide/report/metrics.json"), written);
}

TEST_F(SketchAblationTest, RefusesWithoutDataAndUnknownOptionsNamingTheRow) {
  const SketchAblation task;
  testing::ExpectError([&] { task.ResolvedConfig(Json::object(), 1, "person", "row 'a'"); },
                       "row 'a': it needs data.faces=FOLDER");
  testing::ExpectError([&] { task.ResolvedConfig(Json::object(), 1, "persons", "row 'a'"); }, "did you mean 'person'?");
  testing::ExpectError([&] { task.ResolvedEval({{"strenght", 1}}, "row 'a'"); }, "did you mean 'strength'?");
}

TEST(SketchAblationMeasure, ReadsALineByItsNameAndShapeInput) {
  const SketchAblation task;
  const auto line = [](const char* name, const char* input, double error) {
    return Json{{"name", name},   {"shape_input", input}, {"error", error},
                {"error_low", 1}, {"error_high", 3},      {"p90", 4}};
  };
  const Json metrics = {
      {"table", {line("network", "given", 2), line("network", "recovered", 2.5), line("fit", "none", 6)}},
      {"shape_input", "recovered"},
      {"num_faces", 2},
      {"data_hash", {{"faces", "f"}}},
      {"faces", {3, 5}},
      {"face_errors_mm", {1.5, 3.5}},
      {"groups", {0, 1}}};
  EXPECT_EQ(task.Measure(metrics, "", "").error, 2.5) << "the run's own result";
  EXPECT_EQ(task.Measure(metrics, "", "").face_errors, (std::vector<double>{1.5, 3.5}));
  EXPECT_EQ(task.Measure(metrics, "", "").more.at("p90"), 4);
  EXPECT_EQ(task.Measure(metrics, "", "given").error, 2);
  EXPECT_TRUE(task.Measure(metrics, "", "given").face_errors.empty()) << "they are the result's";
  EXPECT_EQ(task.Measure(metrics, "fit", "").error, 6);
  EXPECT_TRUE(task.Measure(metrics, "fit", "").face_errors.empty());
  testing::ExpectError([&] { task.Measure(metrics, "ridge", ""); }, "no line 'ridge'");
  testing::ExpectError([&] { task.Measure(Json::object(), "", ""); }, "malformed");
}

}  // namespace
}  // namespace daumier::train
