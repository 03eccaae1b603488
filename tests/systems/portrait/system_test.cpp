#include "systems/portrait/system.h"

#include "core/config.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace daumier::portrait {
namespace {

TEST(LandmarkSystem, ResolvesItsOptionsAndRefusesUnknownOnes) {
  const systems::System system = LandmarkSystem();
  const Json resolved = system.resolve_config({{"system", "landmarks"}, {"data", {{"portraits", "p"}}}}, "c.toml");
  EXPECT_EQ(resolved["network"]["resolution"], 128);
  EXPECT_EQ(system.resolve_config(resolved, "c.toml"), resolved);
  EXPECT_EQ(system.resolve_evaluation(Json::object(), "eval")["split"], "test");
  EXPECT_EQ(system.resolve_prediction(Json::object(), "predict")["detector"]["rounds"], 2);
  testing::ExpectError([&] { system.resolve_prediction({{"landmark", "x"}}, "predict"); }, "unknown key 'landmark'");
  testing::ExpectError([&] { system.resolve_evaluation({{"rival", "x"}}, "eval"); }, "rival needs pictures");
}

TEST(LandmarkSystem, EveryConfigOfTheRoomIsParsed) {
  int num_configs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::SourceRoot() / "configs" / "portrait")) {
    const Json config = LoadConfig(entry.path(), {"data.portraits=\"x\""});
    if (config.value("system", "") != "landmarks") continue;
    EXPECT_EQ(LandmarkSystem().resolve_config(config, entry.path().string())["system"], "landmarks");
    ++num_configs;
  }
  EXPECT_GT(num_configs, 0);
}

}  // namespace
}  // namespace daumier::portrait
