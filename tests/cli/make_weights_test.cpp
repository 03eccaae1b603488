// tools/make_weights.sh, with a program that only records how it is called and leaves the files of a finished step.
#include "core/files.h"
#include "core/json.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kRecorder = R"(#!/bin/sh
here=$(dirname "$0")
echo "$*" >> "$here/log"
out=
before=
for word in "$@"; do
  [ "$before" != --out ] || out=$word
  before=$word
done
[ "$1" != eval ] || out=$2/report
mkdir -p "$out/best"
touch "$out/manifest.json"
[ "$1" != train ] || [ ! -f "$here/stop" ] || exit 1
[ "$1" != train ] || touch "$out/best/model.onnx"
)";

class MakeWeightsTest : public ::testing::Test {
 protected:
  MakeWeightsTest() {
    WriteFileAtomically(folder_ / "daumier", kRecorder);
    fs::permissions(folder_ / "daumier", fs::perms::owner_all);
    WriteFileAtomically(folder_ / "ict.tar.xz", "faces");
  }

  ProcessResult Make(const std::vector<std::string>& variables = {}) const {
    std::vector<std::string> command = {"/usr/bin/env", "PATH=" + folder_.path().string() + ":/usr/bin:/bin"};
    command.insert(command.end(), variables.begin(), variables.end());
    for (const fs::path& word :
         {SourceRoot() / "tools/make_weights.sh", folder_ / "ict.tar.xz", folder_ / "weights", folder_ / "work"})
      command.push_back(word.string());
    return RunProcess(command);
  }
  /// First words of the calls since the last time.
  std::vector<std::string> Calls() const {
    std::vector<std::string> calls;
    std::string text = fs::exists(folder_ / "log") ? ReadFile(folder_ / "log") : "";
    fs::remove(folder_ / "log");
    for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
      calls.push_back(text.substr(at, text.find('\n', at) - at));
    return calls;
  }

  const TempDir folder_;
};

TEST_F(MakeWeightsTest, MakesEachOfTheOthersAndRecordsTheCommands) {
  const ProcessResult result = Make({"PICTURES=/mine/pictures", "ONLY=portraits"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Calls(),
              ElementsAre(StartsWith("dataset model"), StartsWith("dataset faces"), StartsWith("dataset portraits"),
                          StartsWith("train"), StartsWith("eval"), StartsWith("export"), StartsWith("train"),
                          StartsWith("eval"), StartsWith("export")));
  const Json recipe = ReadJson(folder_ / "work/steps/landmarks.recipe");
  ASSERT_EQ(recipe.size(), 4U);
  EXPECT_EQ(recipe[0].at("command"),
            "daumier dataset faces --config configs/faces/caricature.toml --out WORK/faces source.path=ICT "
            "num_persons=150 expressions=[\"neutral\"]");
  EXPECT_THAT(recipe[2].at("command").get<std::string>(),
              StartsWith("daumier train configs/portrait/landmarks.toml --out WORK/runs/landmarks "));
  EXPECT_EQ(recipe[3].at("command"), "daumier eval WORK/runs/landmarks pictures=PICTURES");
  for (const Json& step : recipe) EXPECT_GE(step.at("seconds").get<int>(), 0);
  EXPECT_THAT(result.err, HasSubstr("(seed 1)"));
}

TEST_F(MakeWeightsTest, DrawingsHaveDataAndWeightsOfTheirOwn) {
  const ProcessResult result = Make({"ONLY=drawings", "SKETCH_PERSONS=7"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Calls(),
              ElementsAre(StartsWith("dataset model"), HasSubstr("num_persons=7"), StartsWith("dataset sketches"),
                          HasSubstr("side.toml"), HasSubstr("parser.toml"), StartsWith("eval"), StartsWith("export"),
                          HasSubstr("drawings.toml"), StartsWith("eval"), StartsWith("export")));
  const Json recipe = ReadJson(folder_ / "work/steps/sketch-ict.recipe");
  ASSERT_EQ(recipe.size(), 4U);
  EXPECT_EQ(
      recipe[1].at("command"),
      "daumier dataset sketches --config configs/sketches/styles.toml --out WORK/sketches faces=WORK/drawn_faces");
  const ProcessResult unknown = Make({"ONLY=masks"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown kind 'masks'"));
}

TEST_F(MakeWeightsTest, GesturesNeedNoFaces) {
  const ProcessResult result = Make({"ONLY=gestures", "GESTURE_HANDS=9"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Calls(), ElementsAre(StartsWith("dataset model"), HasSubstr("num_hands=9"), HasSubstr("cpu.toml"),
                                   StartsWith("eval"), StartsWith("export")));
  EXPECT_EQ(ReadJson(folder_ / "work/steps/gestures.recipe").size(), 3U);
}

TEST_F(MakeWeightsTest, FinishedStepsAreSkipped) {
  ASSERT_EQ(Make().exit_code, 0);
  Calls();
  const ProcessResult again = Make();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_TRUE(Calls().empty());
  EXPECT_THAT(again.err, HasSubstr("ship_portrait: finished, skipped"));
  EXPECT_THAT(again.err, HasSubstr("ship_sketch-ict: finished, skipped"));
}

TEST_F(MakeWeightsTest, AStoppedTrainingResumes) {
  WriteFileAtomically(folder_ / "stop", "");
  EXPECT_NE(Make().exit_code, 0);
  EXPECT_THAT(Calls().back(), StartsWith("train"));
  fs::remove(folder_ / "stop");
  ASSERT_EQ(Make().exit_code, 0);
  EXPECT_THAT(Calls().front(), ::testing::AllOf(StartsWith("train"), HasSubstr(" --resume ")));
  EXPECT_THAT(ReadFile(folder_ / "work/steps/landmarks.recipe"), ::testing::Not(HasSubstr("--resume")));
}

TEST_F(MakeWeightsTest, AnotherSettingRepeatsWhatDependsOnIt) {
  ASSERT_EQ(Make().exit_code, 0);
  Calls();
  ASSERT_EQ(Make({"PORTRAIT_EPOCHS=40"}).exit_code, 0);
  EXPECT_THAT(Calls(), ElementsAre(HasSubstr("epochs=40"), StartsWith("eval"), StartsWith("export")));
}

TEST_F(MakeWeightsTest, AMissingSourceIsNamed) {
  fs::remove(folder_ / "ict.tar.xz");
  const ProcessResult result = Make();
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("ict.tar.xz does not exist"));
  EXPECT_TRUE(Calls().empty());
}

}  // namespace
}  // namespace daumier::testing
