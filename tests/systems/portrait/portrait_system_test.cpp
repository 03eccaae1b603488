#include "systems/portrait/portrait_system.h"

#include "core/config.h"
#include "systems/portrait/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <filesystem>

namespace daumier::portrait {
namespace {

TEST(PortraitSystem, ResolvesItsOptionsAndRefusesUnknownOnes) {
  const systems::System system = PortraitSystem();
  const Json config = {{"system", "portrait"}, {"data", {{"faces", "f"}, {"portraits", "p"}}}};
  const Json resolved = system.resolve_config(config, "c.toml");
  EXPECT_EQ(resolved["network"]["depth"], 50);
  EXPECT_EQ(resolved["loss"]["photometric"], 2.0);
  EXPECT_TRUE(std::filesystem::path(resolved["data"]["faces"].get<std::string>()).is_absolute());
  EXPECT_EQ(system.resolve_config(resolved, "c.toml"), resolved);
  EXPECT_EQ(system.resolve_evaluation(Json::object(), "eval")["max_images"], 200);
  EXPECT_EQ(system.resolve_prediction(Json::object(), "predict")["landmark_run"], "");
  Json wrong = config;
  wrong["loss"]["landmark"] = 1;
  testing::ExpectError([&] { system.resolve_config(wrong, "c.toml"); }, "unknown key 'loss.landmark'");
  testing::ExpectError([&] { system.resolve_evaluation({{"rival", "x"}}, "eval"); }, "unknown key 'rival'");
  testing::ExpectError([&] { system.resolve_prediction({{"landmark", "x"}}, "predict"); }, "unknown key 'landmark'");
}

TEST(PortraitSystem, EveryConfigOfTheRoomIsParsed) {
  int num_configs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::SourceRoot() / "configs" / "portrait")) {
    const Json config = LoadConfig(entry.path(), {"data.faces=\"x\"", "data.portraits=\"y\""});
    if (config.value("system", "") != "portrait") continue;
    EXPECT_EQ(PortraitSystem().resolve_config(config, entry.path().string())["system"], "portrait") << entry.path();
    ++num_configs;
  }
  EXPECT_GE(num_configs, 2);
}

TEST(PortraitSystem, ReadsAPictureFromEachOfItsKindsOfFile) {
  const testing::TempDir folder;
  const systems::System system = PortraitSystem();
  for (const char* name : {"a.png", "b.jpg"}) {
    const auto file = folder / name;
    EXPECT_TRUE(std::ranges::count(system.input_extensions, file.extension().string()) == 1) << name;
    render::WriteImage(file, render::Image(5, 7, 3, 90));
    const std::vector<systems::Input> inputs = system.read_inputs(file);
    ASSERT_EQ(inputs.size(), 1U);
    const auto& picture = std::get<render::Image>(inputs[0]);
    EXPECT_EQ(picture.height, 5);
    EXPECT_EQ(picture.width, 7);
    EXPECT_NEAR(picture.at(3, 3, 1), 90, 1);
  }
}

TEST(PortraitSystem, IsARowOfItsRoom) {
  std::vector<std::string> names;
  for (const systems::System& system : PortraitSystems()) names.emplace_back(system.name);
  EXPECT_EQ(names, (std::vector<std::string>{"landmarks", "portrait"}));
}

}  // namespace
}  // namespace daumier::portrait
