// Drawings predicted by the weights of the repository, as a user would.
#include "core/files.h"
#include "core/manifest.h"
#include "render/image.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DrawingsByWeights : public ::testing::Test {
 protected:
  DrawingsByWeights() { fs::copy_file(SourceRoot() / "docs/examples/drawings/girl.svg", folder_ / "girl.svg"); }

  std::string In(const fs::path& name) const { return (folder_ / name).string(); }
  ProcessResult Predict(std::vector<std::string> words, const fs::path& weights = SourceRoot() / "weights") const {
    words.insert(words.begin(), {"/usr/bin/env", "DAUMIER_WEIGHTS=" + weights.string(), DAUMIER_PROGRAM, "--quiet",
                                 "predict", In("girl.svg")});
    return RunProcess(words);
  }

  const TempDir folder_;
};

TEST_F(DrawingsByWeights, TheFrameIsKeptWithoutMatchingContours) {
  const ProcessResult kept = Predict({"--keep-frame", "--out", In("kept")});
  EXPECT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_EQ(ReadManifest(folder_ / "kept", "predictions").config["refine"], false);
  const ProcessResult by_key = Predict({"framing=keep", "--out", In("none")});
  EXPECT_EQ(by_key.exit_code, 2);
  EXPECT_THAT(by_key.err, HasSubstr("give refine=false"));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(DrawingsByWeights, TheParserIsNamedByFolderOrName) {
  const ProcessResult by_name = Predict({"parser=parser", "--out", In("by_name")});
  EXPECT_EQ(by_name.exit_code, 0) << by_name.err;
  const ProcessResult absent = Predict({"parser=nowhere", "--out", In("none")});
  EXPECT_EQ(absent.exit_code, 2);
  EXPECT_THAT(absent.err, AllOf(HasSubstr("parser=nowhere is no folder"), HasSubstr("there are face-ict")));
}

TEST_F(DrawingsByWeights, WithoutWeightsOfMeshesTheyAreParsedWithAWarning) {
  fs::create_directory(folder_ / "weights");
  fs::copy(SourceRoot() / "weights/parser", folder_ / "weights/parser", fs::copy_options::recursive);
  const ProcessResult parsed = Predict({"--out", In("out")}, folder_ / "weights");
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
  EXPECT_THAT(parsed.err, HasSubstr("without a mesh: there are no weights of the task 'sketch' in " + In("weights")));
  EXPECT_TRUE(fs::exists(folder_ / "out/girl.json"));

  // Predictions of another task are not mixed with these.
  const std::string before = ReadFile(folder_ / "out/manifest.json");
  const ProcessResult mixed = Predict({"--out", In("out")});
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, HasSubstr("holds predictions of the task 'drawing_parser', and these are of 'sketch'"));
  EXPECT_EQ(ReadFile(folder_ / "out/manifest.json"), before);
}

TEST_F(DrawingsByWeights, AmongPortraitsOptionsGoToTheTaskThatHasThem) {
  render::Image tones(160, 120, 3);
  for (size_t i = 0; i < tones.pixels.size(); ++i) tones.pixels[i] = uint8_t(60 + (i / 360) % 150);
  render::WriteImage(folder_ / "tones.png", tones);
  const ProcessResult both = Predict({In("tones.png"), "--no-fit", "parsing.rounds=1", "--out", In("both")});
  EXPECT_THAT(both.err, Not(HasSubstr("unknown")));
  EXPECT_TRUE(fs::exists(folder_ / "both/sketch-ict/girl.obj")) << both.err;
  EXPECT_EQ(ReadManifest(folder_ / "both/sketch-ict", "predictions").config["fit"], false);
  const ProcessResult misspelt = Predict({In("tones.png"), "fitt=false", "--out", In("none")});
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("fitt"));
}

TEST_F(DrawingsByWeights, ABlankSheetIsADrawingWithoutLines) {
  render::WriteImage(folder_ / "blank.png", render::Image(200, 160, 3, 250));
  const ProcessResult blank = Predict({In("blank.png"), "--out", In("out")});
  EXPECT_EQ(blank.exit_code, 1);
  EXPECT_THAT(blank.err, AllOf(HasSubstr("blank.png"), HasSubstr("holds no lines"), Not(HasSubstr("face"))));
  EXPECT_TRUE(fs::exists(folder_ / "out/girl.obj")) << "one kind of input: no folder of weights";
}

}  // namespace
}  // namespace daumier::testing
