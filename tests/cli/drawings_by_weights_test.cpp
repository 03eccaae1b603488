// Drawings predicted by the weights of the repository, as a user would.
#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

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

TEST_F(DrawingsByWeights, SeveralProgramsMayWriteIntoOneFolder) {
  std::vector<std::jthread> programs;
  std::vector<ProcessResult> results(3);
  for (size_t i = 0; i < results.size(); ++i) {
    const fs::path drawing = folder_ / fmt::format("girl{}.svg", i);
    fs::copy_file(folder_ / "girl.svg", drawing);
    programs.emplace_back([&, i, drawing] {
      results[i] =
          RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (SourceRoot() / "weights").string(), DAUMIER_PROGRAM,
                      "--quiet", "--threads", "1", "predict", drawing.string(), "--out", In("out")});
    });
  }
  programs.clear();
  for (const ProcessResult& result : results) EXPECT_EQ(result.exit_code, 0) << result.err;
  const Manifest manifest = ReadManifest(folder_ / "out", "predictions");
  EXPECT_EQ(manifest.details.at("drawings").size(), 3u);
  EXPECT_NO_THROW(VerifyChecksums(folder_ / "out", manifest));
}

TEST_F(DrawingsByWeights, TooLittleMemoryEndsTheProgramWithTheRepair) {
  for (const int megabytes : {300, 600, 1000}) {
    const std::string limited =
        fmt::format("ulimit -v {}; exec \"$0\" --quiet predict \"$1\" --out \"$2\"", megabytes << 10);
    const ProcessResult result =
        RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (SourceRoot() / "weights").string(), "timeout", "60", "sh",
                    "-c", limited, DAUMIER_PROGRAM, In("girl.svg"), In("out")});
    EXPECT_EQ(result.exit_code, 1) << megabytes << " MB";
    EXPECT_THAT(result.err, AllOf(HasSubstr("not enough memory"), HasSubstr("ulimit -v 1048576")));
  }
}

TEST_F(DrawingsByWeights, WhatIsNoInputIsNamed) {
  const auto refused = [&](const std::string& word, const std::string& why) {
    const ProcessResult result = RunProcess({DAUMIER_PROGRAM, "--quiet", "predict", word, "--out", In("out")});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr(word), HasSubstr(why)));
  };
  fs::create_directory(folder_ / "empty");
  WriteFileAtomically(folder_ / "letter.docx", "text");
  refused(In("empty"), "holds no file that predict reads (expected ");
  refused(In("letter.docx"), "is no file that predict reads (expected ");
  refused(In("nowhere"), "does not exist");
  const ProcessResult long_name = Predict({"--out", In(std::string(300, 'x'))});
  EXPECT_EQ(long_name.exit_code, 1);
  EXPECT_THAT(long_name.err, AllOf(HasSubstr("cannot access "), HasSubstr("File name too long")));
  refused((SourceRoot() / "weights/parser").string(), "at least one input file besides");
}

TEST_F(DrawingsByWeights, ASessionIsReplayedToTheSameBytes) {
  Json example = ReadJson(SourceRoot() / "docs/examples/sessions/front.json");
  auto& events = example.at("events").get_ref<Json::array_t&>();
  events.erase(events.begin() + 2, events.end() - 10);  // Two strokes; curves of the last are redrawn after follow_up.
  events.insert(events.begin() + 2, Json{{"do", "follow_up"}});
  const std::string session = In("session.json");
  WriteFileAtomically(session, example.dump());
  const auto replay = [&](const std::string& out) {
    return RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (SourceRoot() / "weights").string(), DAUMIER_PROGRAM,
                       "--quiet", "predict", "--session", session, "--out", In(out)});
  };
  for (const char* out : {"first", "second"}) {
    const ProcessResult result = replay(out);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const Manifest manifest = ReadManifest(folder_ / "first", "session");
  EXPECT_EQ(manifest.counts.at("states"), 13);
  EXPECT_NO_THROW(VerifyChecksums(folder_ / "first", manifest));
  EXPECT_EQ(ReadFile(folder_ / "first/manifest.json"), ReadFile(folder_ / "second/manifest.json"));
  WriteFileAtomically(folder_ / "torn.json", ReadFile(session).substr(0, 500));
  const ProcessResult torn =
      RunProcess({DAUMIER_PROGRAM, "--quiet", "predict", "--session", In("torn.json"), "--out", In("none")});
  EXPECT_EQ(torn.exit_code, 1);
  EXPECT_THAT(torn.err, HasSubstr("torn.json"));
  const ProcessResult both = Predict({"--session", session, "--out", In("none")});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("neither inputs nor key=value"));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(DrawingsByWeights, ASessionBeginsWithAFaceThatLiesAsTheTemplateDoes) {
  const auto replay = [&](const std::string& begin, const std::string& out) {
    const Json session = {
        {"version", 1}, {"sheet", {256, 256}}, {"begin", begin}, {"events", {{{"do", "follow_up"}}, {{"do", "undo"}}}}};
    WriteFileAtomically(folder_ / "begin.json", session.dump());
    return RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (SourceRoot() / "weights").string(), DAUMIER_PROGRAM,
                       "--quiet", "predict", "--session", In("begin.json"), "--out", In(out)});
  };
  ASSERT_EQ(replay("mean", "mean").exit_code, 0);
  EXPECT_EQ(replay("mean/000.obj", "again").exit_code, 0);
  EXPECT_EQ(ReadFile(folder_ / "again/000.obj"), ReadFile(folder_ / "mean/000.obj"));
  const ProcessResult within = replay("mean/000.obj", "mean");
  EXPECT_EQ(within.exit_code, 2);
  EXPECT_THAT(within.err, HasSubstr("lies in the folder to write"));
  geometry::PolygonMesh moved = geometry::ReadObj(folder_ / "mean/000.obj");
  moved.vertices.col(0).array() += 100;
  geometry::WriteObj(folder_ / "moved.obj", moved);
  const ProcessResult far = replay("moved.obj", "far");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_THAT(far.err, HasSubstr("moved by 100.0 cm"));
  EXPECT_FALSE(fs::exists(folder_ / "far"));
}

TEST_F(DrawingsByWeights, AnAvatarOfADrawingHasPlainColoursOrThoseOfItsPaper) {
  const auto avatar = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {DAUMIER_PROGRAM, "--quiet", "avatar"});
    return RunProcess(options);
  };
  const ProcessResult result = avatar({In("girl.svg"), "--out", In("girl.glb"), "--hair", "long", "--stages",
                                       In("stages"), "palette.iris=green", "avatar.texture.size=128", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json facts = Json::parse(result.out);
  EXPECT_EQ(facts.at("palette").at("skin").at("from"), "plain");
  EXPECT_EQ(facts.at("palette").at("iris").at("colour"), "#008000");
  EXPECT_EQ(facts.at("targets"), 52);
  for (const char* file :
       {"girl.glb", "girl.png", "stages/01_drawing.png", "stages/02_texture.png", "stages/times.json"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  EXPECT_NE(ReadFile(folder_ / "girl.glb").find("\"Hair\""), std::string::npos);

  // The same drawing with a filled face, lips and irises.
  std::string coloured = ReadFile(SourceRoot() / "docs/examples/drawings/girl.svg");
  const auto fill = [&](const std::string& begin, const std::string& colour) {
    for (size_t at = coloured.find(begin); at != std::string::npos; at = coloured.find(begin, at + 10))
      coloured.insert(coloured.find('<', at) + 5, " fill=\"" + colour + "\"");
  };
  fill("<path d=\"M132 216", "#e8b08a");
  fill("<path d=\"M182 296", "#d04060");
  for (size_t at = coloured.find("r=\"10\""); at != std::string::npos; at = coloured.find("r=\"10\"", at + 20))
    coloured.insert(at, "fill=\"#3070e0\" ");
  WriteFileAtomically(folder_ / "coloured.svg", coloured);
  const ProcessResult drawn =
      avatar({In("coloured.svg"), "--out", In("coloured.glb"), "avatar.texture.size=128", "--json"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const Json palette = Json::parse(drawn.out).at("palette");
  EXPECT_EQ(palette.at("skin").at("colour"), "#e8b08a");
  EXPECT_EQ(palette.at("lips").at("colour"), "#d04060");
  EXPECT_EQ(palette.at("iris").at("colour"), "#3070e0");
  EXPECT_EQ(palette.at("brows").at("from"), "plain");

  const ProcessResult styled = avatar({In("girl.svg"), "--style", "toon", "--out", In("styled.glb")});
  EXPECT_EQ(styled.exit_code, 2);
  EXPECT_THAT(styled.err, HasSubstr("are for portraits"));
  const ProcessResult colour = avatar({In("girl.svg"), "palette.skin=skinny", "--out", In("styled.glb")});
  EXPECT_EQ(colour.exit_code, 2);
  EXPECT_THAT(colour.err, HasSubstr("palette.skin=skinny: is no colour"));
  const ProcessResult portrait = avatar({In("girl.svg"), "--as", "portrait", "--out", In("styled.glb")});
  EXPECT_EQ(portrait.exit_code, 2);
  EXPECT_THAT(portrait.err, HasSubstr("leave out --as portrait"));
  EXPECT_FALSE(fs::exists(folder_ / "styled.glb"));
}

TEST_F(DrawingsByWeights, DamagedWeightsAreNotCalledAbsent) {
  fs::copy(SourceRoot() / "weights", folder_ / "weights", fs::copy_options::recursive);
  const fs::path manifest = folder_ / "weights/face-ict/manifest.json";
  WriteFileAtomically(manifest, ReadFile(manifest).substr(0, 100));
  const std::string named = In("weights/sketch-ict");
  const ProcessResult result = Predict({"--weights", named, "--out", In("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("face-ict: weights whose manifest.json is missing or malformed"),
                                HasSubstr("Restore the folder")));
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
