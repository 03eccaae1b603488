#include "train/train_run.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/train/toy_recipe.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

RunStart StartOf(int epochs) {
  RunStart start{
      .options = {{"epochs", epochs}, {"data", {{"faces", "/faces"}}}}, .defaults = Json::object(), .manifest = {}};
  start.manifest.kind = "run";
  start.manifest.verb = "train";
  start.manifest.config = {{"epochs", epochs}};
  start.manifest.details = {{"data", {{"faces", "abc"}}}};
  return start;
}

TrainingSummary TrainToy(const std::filesystem::path& folder, int epochs) {
  toy::ToyRecipe recipe;
  return TrainRun(recipe, {.epochs = epochs, .batch = 4}, {}, 3, folder);
}

TEST(StartRun, WritesConfigAndManifestAndResumesTheSameRunAlone) {
  const testing::TempDir folder;
  EXPECT_FALSE(StartRun(folder / "run", false, StartOf(1)));
  EXPECT_EQ(ReadFile(ResolvedConfig(folder / "run")), "epochs = 1\ndata.faces = \"/faces\"\n");
  EXPECT_EQ(ReadManifest(folder / "run", "run").config, (Json{{"epochs", 1}}));
  EXPECT_TRUE(StartRun(folder / "run", true, StartOf(1)));
  testing::ExpectError([&] { StartRun(folder / "run", false, StartOf(1)); }, "already holds a run");
  RunStart other = StartOf(1);
  other.manifest.details["data"]["faces"] = "def";
  testing::ExpectError([&] { StartRun(folder / "run", true, other); }, "data.faces is \"abc\" there");
}

TEST(TrainRun, NotesTheEndAndAFinishedRunGetsLonger) {
  const testing::TempDir folder;
  StartRun(folder / "run", false, StartOf(1));
  EXPECT_EQ(TrainToy(folder / "run", 1).steps, 5);
  const Json counts = ReadManifest(folder / "run", "run").counts;
  EXPECT_EQ(counts.at("parameters"), NumParameters(toy::ToyRecipe().product()));
  EXPECT_EQ(counts.at("best_epoch"), 1);
  StartRun(folder / "run", true, StartOf(2));
  EXPECT_EQ(TrainToy(folder / "run", 2).steps, 10);
}

TEST(NumParameters, AddsWeightsAndBiases) {
  EXPECT_EQ(NumParameters(*torch::nn::Linear(3, 2)), 8);
}

}  // namespace
}  // namespace daumier::train
