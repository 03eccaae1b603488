#include "systems/sketch/system.h"

#include "core/config.h"
#include "render/svg.h"
#include "systems/sketch/gesture_run_folder.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/run_folder.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

const Json kConfig = {{"system", "sketch"}, {"data", {{"faces", "faces"}, {"sketches", "sketches"}}}};

TEST(SketchSystem, HasItsNameAndRoom) {
  const systems::System system = SketchSystem();
  EXPECT_EQ(system.name, kSystem);
  EXPECT_EQ(system.room, "systems/sketch");
  EXPECT_EQ(system.run_options, std::vector<std::string>{"recover_with"});
}

TEST(SketchSystem, HelpListsTheOptionsOfTrainingAndEvaluation) {
  EXPECT_NE(SketchSystem().training_help().find("epochs"), std::string::npos);
  const std::string help = SketchSystem().evaluation_help();
  for (const char* const option : {"recover_with", "split", "faces", "sketches"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
}

TEST(SketchSystem, AResolvedConfigHasEveryOptionAndResolvesToItself) {
  const Json resolved = SketchSystem().resolve_config(kConfig, "recipe.toml");
  EXPECT_EQ(resolved["network"]["trunk"], "compact");
  EXPECT_EQ(resolved["epochs"], 20);
  EXPECT_EQ(resolved["seed"], 1);
  EXPECT_EQ(resolved["data"]["faces"], (std::filesystem::current_path() / "faces").string());
  EXPECT_EQ(SketchSystem().resolve_config(resolved, "recipe.toml"), resolved);
}

TEST(SketchSystem, UnknownKeysAreUsageErrors) {
  const systems::System system = SketchSystem();
  Json config = kConfig;
  config["epoch"] = 3;
  EXPECT_THROW(system.resolve_config(config, "recipe.toml"), UsageError);
  ExpectError([&] { system.resolve_config(config, "recipe.toml"); }, "recipe.toml: unknown key 'epoch'");
  EXPECT_THROW(system.resolve_evaluation({{"splits", "test"}}, "options"), UsageError);
  EXPECT_THROW(system.resolve_prediction({{"refined", true}}, "options"), UsageError);
}

TEST(SketchSystem, AResolvedEvaluationHasEveryOption) {
  const Json own = SketchSystem().resolve_evaluation({{"fit", true}}, "options");
  EXPECT_EQ(own["split"], "test");
  EXPECT_EQ(own["fit"], true);
  EXPECT_EQ(own["faces"], "");
  const Json external = SketchSystem().resolve_evaluation({{"faces", "a"}, {"sketches", "b"}}, "options");
  EXPECT_EQ(external["faces"], "a");
  EXPECT_EQ(external["sketches"], "b");
  EXPECT_EQ(external["baselines"], true);
}

TEST(SketchSystem, AnEvaluationIsChecked) {
  const auto resolve = [](const Json& options) { return SketchSystem().resolve_evaluation(options, "eval"); };
  EXPECT_THROW(resolve({{"faces", "a"}}), UsageError);
  const Json resolved = resolve({{"faces", "a"}, {"sketches", "b"}});
  EXPECT_EQ(resolve(resolved), resolved);
}

TEST(SketchSystem, AWidthThatIsNoMultipleOfABlockIsAUsageError) {
  Json config = kConfig;
  config["network"] = {{"width", 12}};
  EXPECT_THROW(SketchSystem().resolve_config(config, "recipe.toml"), UsageError);
}

TEST(SketchSystem, APredictionFindsTheFrameAndFitsByDefault) {
  const Json resolved = SketchSystem().resolve_prediction({{"parser", "runs/parser"}}, "options");
  EXPECT_EQ(resolved["framing"], "fit");
  EXPECT_EQ(resolved["fit"], true);
  EXPECT_EQ(resolved["refine"], true);
  EXPECT_EQ(resolved["parser"], "runs/parser");
  EXPECT_GT(resolved["fitting"]["prior_share"], 0.0);
  ExpectError([] { SketchSystem().resolve_prediction({{"deform", true}}, "options"); }, "unknown key 'deform'");
}

TEST(ParserSystem, HasItsNameAndHelp) {
  const systems::System system = ParserSystem();
  EXPECT_EQ(system.name, kParserSystem);
  EXPECT_EQ(system.room, "systems/sketch");
  EXPECT_NE(system.training_help().find("drawings"), std::string::npos);
  EXPECT_NE(system.evaluation_help().find("data.sketches"), std::string::npos);
  EXPECT_LT(system.shipped_rank, SketchSystem().shipped_rank) << "a drawing is predicted rather than parsed";
}

TEST(ParserSystem, AResolvedConfigHasEveryOptionAndResolvesToItself) {
  Json config = kConfig;
  config["system"] = kParserSystem;
  const Json resolved = ParserSystem().resolve_config(config, "recipe.toml");
  EXPECT_EQ(resolved["network"]["resolution"], 256);
  EXPECT_EQ(ParserSystem().resolve_config(resolved, "recipe.toml"), resolved);
  EXPECT_EQ(ParserSystem().resolve_prediction(Json::object(), "options")["parser"]["rounds"], 2);
  config["epoch"] = 3;
  EXPECT_THROW(ParserSystem().resolve_config(config, "recipe.toml"), UsageError);
}

TEST(GestureSystem, AResolvedConfigHasEveryOptionAndResolvesToItself) {
  const systems::System system = GestureSystem();
  EXPECT_EQ(system.name, kGestureSystem);
  EXPECT_LT(system.shipped_rank, ParserSystem().shipped_rank) << "a drawing is parsed rather than read as gestures";
  Json config = {{"system", kGestureSystem}, {"data", {{"gestures", "gestures"}}}};
  const Json resolved = system.resolve_config(config, "recipe.toml");
  EXPECT_EQ(resolved["network"]["kind"], "compact");
  EXPECT_EQ(resolved["rejection"]["accepted"], 0.97);
  EXPECT_EQ(system.resolve_config(resolved, "recipe.toml"), resolved);
  config["network"] = {{"kind", "papers"}};
  ExpectError([&] { system.resolve_config(config, "recipe.toml"); }, "did you mean 'paper'?");
  ExpectError([&] { system.resolve_config(Json::object(), "recipe.toml"); }, "it needs data.gestures=FOLDER");
  EXPECT_EQ(system.resolve_evaluation({{"none", 5}}, "options")["none"], 5);
}

TEST(GestureSystem, EveryConfigIsParsed) {
  for (const char* file : {"configs/gestures/cpu.toml", "configs/gestures/paper.toml"}) {
    Json config = LoadConfig(testing::SourceRoot() / file);
    config["data"] = {{"gestures", "gestures"}};
    EXPECT_NO_THROW(GestureSystem().resolve_config(config, file)) << file;
  }
}

TEST(SketchSystem, ReadsTheDrawingOfAnSvg) {
  const testing::TempDir folder;
  const auto strokes = fitting::Circles();
  render::WriteSvg(folder / "circles.svg", strokes, {"line"});
  const std::vector<systems::Input> inputs = SketchSystem().read_inputs(folder / "circles.svg");
  ASSERT_EQ(inputs.size(), 1u);
  const auto* drawing = std::get_if<render::Drawing>(&inputs[0]);
  ASSERT_NE(drawing, nullptr);
  EXPECT_EQ(drawing->width, render::kSketchCanvas);
  ASSERT_EQ(drawing->strokes.size(), strokes.size());
  for (size_t i = 0; i < strokes.size(); ++i) EXPECT_EQ(drawing->strokes[i].points, strokes[i].points);
  ExpectError([&] { SketchSystem().read_inputs(folder / "absent.svg"); }, "absent.svg");
}

}  // namespace
}  // namespace daumier::sketch
