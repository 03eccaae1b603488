#include "systems/deform/train/system.h"

#include "ablation/ablation.h"
#include "core/files.h"
#include "core/manifest.h"
#include "systems/deform/metrics.h"
#include "systems/deform/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_points.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

ablation::AblationSystem System() {
  static const systems::System system = DeformSystem();
  static const systems::SystemTraining training = DeformTraining();
  return {system, training};
}

constexpr const char* kTable = R"(
splits = ["random"]
[config]
product = "deform"
network = {latent = 8, width = 32, hidden_layers = 1, hyper_width = 16, array_width = 16}
points = {num_points = 20}
validation = {faces = 2, newton_steps = 2}
epochs = 2
batch = 8
[eval]
max_faces = 3
adam_faces = 1
adam_steps = 2
[[rows]]
name = "siren"
[[rows]]
name = "array"
config.network.kind = "displacements"
eval.baselines = false
[[rows]]
name = "components"
config.network.kind = "linear"
eval.baselines = false
[[rows]]
name = "by Adam"
from = "siren"
line = "network, first faces by Adam"
)";

class DeformSystemTest : public ::testing::Test {
 protected:
  DeformSystemTest() {
    testing::BuildSyntheticFaces(folder_ / "faces");
    testing::BuildSyntheticPoints(folder_ / "faces", folder_ / "points");
    WriteFileAtomically(folder_ / "table.toml", kTable);
  }

  ablation::Ablation Load() const {
    return ablation::LoadAblation(
        folder_ / "table.toml",
        {"data.faces=" + (folder_ / "faces").string(), "data.points=" + (folder_ / "points").string()}, {});
  }

  const testing::TempDir folder_;
};

TEST_F(DeformSystemTest, AnAblationTrainsAndMeasuresEveryRow) {
  const fs::path out = folder_ / "out";
  const Json table = ablation::RunAblation(Load(), System(), out);
  std::vector<std::string> names;
  for (const Json& row : table) names.push_back(row["name"].get<std::string>());
  EXPECT_EQ(names, (std::vector<std::string>{"template", "mean face", "nearest training face", "linear model", "siren",
                                             "array", "components", "by Adam"}));
  const Json metrics = Json::parse(ReadFile(out / "random/seed1/siren/report/metrics.json"));
  const Json &siren = table[4], &components = table[6], &by_adam = table[7];
  EXPECT_NEAR(siren["error"].get<double>(), metrics["mean_vertex_error_mm"].get<double>(), 1e-9);
  EXPECT_EQ(siren["model_units"], metrics["mean_vertex_error"]);
  for (const char* key : {"error_high", "p95", "surface_sample_error_mm", "percent_of_head_height", "parameters",
                          "train_seconds", "infer_ms", "equal_seconds"})
    EXPECT_GT(siren[key].get<double>(), 0) << key;
  EXPECT_NEAR(table[1]["difference"].get<double>(), table[1]["error"].get<double>() - siren["error"].get<double>(),
              1e-9)
      << "baselines have face errors, too";
  EXPECT_TRUE(by_adam["difference"].is_null()) << "of one face alone";
  EXPECT_EQ(components["steps"], 0) << "nothing is trained by steps";
  EXPECT_EQ(table[5]["equal_seconds"], siren["equal_seconds"]);
  // The first to end has been validated by then.
  EXPECT_TRUE(siren["validation_at_equal_time"].is_number() || table[5]["validation_at_equal_time"].is_number());
  EXPECT_EQ(by_adam["num_faces"], 1);
  EXPECT_TRUE(by_adam["steps"].is_null());
  EXPECT_EQ(ReadManifest(out / "random/seed1/array/run", "run").config.at("split").at("kind"), "random");
  for (const char* file : {"sheet.png", "curves.svg", "curves_by_time.svg", "index.html", "table.md"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  EXPECT_EQ(ablation::RunAblation(Load(), System(), out), table) << "nothing is trained or measured again";
}

TEST_F(DeformSystemTest, RefusesWithoutDataAndUnknownOptionsNamingTheRow) {
  testing::ExpectError([&] { DeformSystem().resolve_config(Json::object(), "row 'a'"); }, "row 'a': it needs data.faces=FOLDER");
  testing::ExpectError([&] { DeformSystem().resolve_evaluation({{"max_face", 1}}, "row 'a'"); }, "did you mean 'max_faces'?");
}

TEST(DeformAblationConfigs, AreParsed) {
  for (const char* file : {"configs/deform/ablation_cpu.toml", "configs/deform/rates_cpu.toml",
                           "configs/deform/schedules_cpu.toml", "configs/deform/subsets_cpu.toml"}) {
    const ablation::Ablation ablation =
        ablation::LoadAblation(testing::SourceRoot() / file, {"data.faces=faces", "data.points=points"}, {});
    EXPECT_FALSE(ablation::PlanAblation(ablation, System(), "absent").empty()) << file;
  }
}

}  // namespace
}  // namespace daumier::deform
