#include "systems/deform/system.h"

#include "systems/deform/run_folder.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

using testing::ExpectError;

const Json kConfig = {{"system", "deform"}, {"data", {{"faces", "faces"}, {"points", "points"}}}};

TEST(DeformSystem, HasItsNameAndRoomAndNoPredictor) {
  const systems::System system = DeformSystem();
  EXPECT_EQ(system.name, kSystem);
  EXPECT_EQ(system.room, "systems/deform");
  EXPECT_EQ(system.resolve_prediction, nullptr);
  EXPECT_EQ(system.open, nullptr);
  EXPECT_EQ(system.read_inputs, nullptr);
}

TEST(DeformSystem, HelpListsTheOptionsOfTrainingAndEvaluation) {
  EXPECT_NE(DeformSystem().training_help().find("epochs"), std::string::npos);
  EXPECT_NE(DeformSystem().evaluation_help().find("adam_faces"), std::string::npos);
}

TEST(DeformSystem, AResolvedConfigHasEveryOptionAndResolvesToItself) {
  const Json resolved = DeformSystem().resolve_config(kConfig, "recipe.toml");
  EXPECT_EQ(resolved["network"]["kind"], "hypernetwork");
  EXPECT_EQ(resolved["optimiser"]["learning_rate"], 1e-4);
  EXPECT_EQ(resolved["epochs"], 20);
  EXPECT_EQ(resolved["data"]["points"], (std::filesystem::current_path() / "points").string());
  EXPECT_EQ(DeformSystem().resolve_config(resolved, "recipe.toml"), resolved);
}

TEST(DeformSystem, AnEvaluationIsOfTheTestSideByDefault) {
  const Json resolved = DeformSystem().resolve_evaluation({{"max_faces", 3}}, "options");
  EXPECT_EQ(resolved["split"], "test");
  EXPECT_EQ(resolved["max_faces"], 3);
  EXPECT_EQ(resolved["baselines"], true);
}

TEST(DeformSystem, AnEvaluationOnOtherFacesMeasuresAllOfThem) {
  ExpectError(
      [] {
        DeformSystem().resolve_evaluation({{"faces", "a"}, {"split", "validation"}}, "eval");
      },
      "eval: faces excludes split");
  const Json resolved = DeformSystem().resolve_evaluation({{"faces", "a"}}, "eval");
  EXPECT_EQ(DeformSystem().resolve_evaluation(resolved, "eval"), resolved);
}

TEST(DeformSystem, UnknownKeysAreUsageErrors) {
  const systems::System system = DeformSystem();
  Json config = kConfig;
  config["epoch"] = 3;
  EXPECT_THROW(system.resolve_config(config, "recipe.toml"), UsageError);
  ExpectError([&] { system.resolve_config(config, "recipe.toml"); }, "recipe.toml: unknown key 'epoch'");
  EXPECT_THROW(system.resolve_evaluation({{"refine", true}}, "options"), UsageError);
}

}  // namespace
}  // namespace daumier::deform
