#include "core/training.h"

#include "core/no_data.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace daumier {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

struct FolderOptions {
  std::string faces, sketches;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of faces.");
    visit("sketches", sketches, Text{}, "Folder of sketches.");
  }
};

struct SmallTraining {
  FolderOptions data;
  TrainerOptions trainer;
  int layers = 3;

  template <class V>
  void Visit(V&& visit) {
    visit("data", data, Table{}, "Training data.");
    trainer.Visit(visit);
    visit("layers", layers, Range{1, 9}, "Layers of the network.");
  }
};

Json DataConfig(const std::string& faces, const std::string& sketches) {
  return {{"data", {{"faces", faces}, {"sketches", sketches}}}, {"layers", 5}};
}

TEST(WithAbsoluteData, RelativeFoldersStartAtTheWorkingDirectory) {
  const Json config = WithAbsoluteData(DataConfig("runs/../faces", "/data/sketches"), "recipe.toml");
  EXPECT_EQ(config["data"]["faces"], (fs::current_path() / "faces").string());
  EXPECT_EQ(config["data"]["sketches"], "/data/sketches");
  EXPECT_EQ(config["layers"], 5);
  EXPECT_EQ(WithAbsoluteData(config, "recipe.toml"), config);
}

TEST(WithAbsoluteData, AnEmptyFolderIsAUsageErrorThatNamesEveryDataOption) {
  const Json config = DataConfig("faces", "");
  EXPECT_THROW(WithAbsoluteData(config, "recipe.toml"), UsageError);
  ExpectError([&] { WithAbsoluteData(config, "recipe.toml"); },
              "recipe.toml: it needs data.faces=FOLDER and data.sketches=FOLDER");
}

TEST(WithAbsoluteData, AFolderThatATrainingDoesWithoutStays) {
  const Json config = WithAbsoluteData(DataConfig("faces", kNoData), "recipe.toml");
  EXPECT_EQ(config["data"]["sketches"], kNoData);
  EXPECT_EQ(config["data"]["faces"], (fs::current_path() / "faces").string());
}

TEST(ParseTraining, FillsDefaultsAndMakesFoldersAbsolute) {
  const auto options = ParseTraining<SmallTraining>(DataConfig("faces", "sketches"), "recipe.toml");
  EXPECT_EQ(options.data.faces, (fs::current_path() / "faces").string());
  EXPECT_EQ(options.data.sketches, (fs::current_path() / "sketches").string());
  EXPECT_EQ(options.layers, 5);
  EXPECT_EQ(options.trainer.epochs, TrainerOptions().epochs);
}

TEST(ParseTraining, RefusesMissingFoldersUnknownKeysAndValuesOutOfRange) {
  const auto parse = [](const Json& config) { ParseTraining<SmallTraining>(config, "recipe.toml"); };
  ExpectError([&] { parse(Json::object()); }, "it needs data.faces=FOLDER and data.sketches=FOLDER");
  Json config = DataConfig("faces", "sketches");
  config["epoch"] = 3;
  EXPECT_THROW(parse(config), UsageError);
  ExpectError([&] { parse(config); }, "did you mean 'epochs'?");
  config.erase("epoch");
  config["layers"] = 10;
  ExpectError([&] { parse(config); }, "'layers' is 10");
}

TEST(WithSystemKey, RenamesTheKeyOfEarlierVersions) {
  EXPECT_EQ(WithSystemKey({{"product", "deform"}, {"epochs", 2}}), (Json{{"epochs", 2}, {"system", "deform"}}));
  EXPECT_EQ(WithSystemKey({{"epochs", 2}}), (Json{{"epochs", 2}}));
}

}  // namespace
}  // namespace daumier
