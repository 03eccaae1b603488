#include "core/run_manifest.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

using testing::ExpectError;

Manifest RunOf(const Json& details) {
  Manifest manifest;
  manifest.kind = "run";
  manifest.details = details;
  return manifest;
}

TEST(SystemOf, IsTheTaskAndOfOldRunsTheirProduct) {
  EXPECT_EQ(SystemOf(RunOf({{"system", "portrait"}})), "portrait");
  EXPECT_EQ(SystemOf(RunOf({{"product", "deform"}})), "deform");
  EXPECT_EQ(SystemOf(RunOf(Json::object())), "sketch");
}

TEST(SystemOf, ATaskThatIsNoTextIsAnError) {
  ExpectError([] { SystemOf(RunOf({{"system", 3}})); }, "names the task 3 (expected a text)");
  ExpectError([] { SystemOf(RunOf({{"product", nullptr}})); }, "names the task null");
}

TEST(ResumeCommand, IsACommandOfAShell) {
  EXPECT_EQ(ResumeCommand("runs/a"), "daumier train runs/a/resolved.toml --out runs/a --resume");
  EXPECT_EQ(ResumeCommand("my runs", "epochs=4"),
            "daumier train 'my runs/resolved.toml' --out 'my runs' --resume epochs=4");
  EXPECT_EQ(ResumeCommand("it's"), R"(daumier train 'it'\''s/resolved.toml' --out 'it'\''s' --resume)");
}

TEST(CheckDataIsThere, NamesTheOptionOfDataThatHaveMoved) {
  const testing::TempDir folder;
  MakeDirectory(folder / "faces");
  const std::string faces = (folder / "faces").string(), moved = (folder / "sketches").string();
  EXPECT_NO_THROW(CheckDataIsThere({{"data", {{"faces", faces}}}}, "runs/a"));
  ExpectError(
      [&] {
        CheckDataIsThere({{"data", {{"faces", faces}, {"sketches", moved}}}}, "runs/a");
      },
      moved +
          " does not exist (expected the sketches that runs/a is trained on). If they have moved, add "
          "data.sketches=FOLDER");
}

TEST(ReadRunConfig, RefusesTheConfigOfAnotherTask) {
  const testing::TempDir folder;
  WriteFileAtomically(ResolvedConfig(folder.path()), "system = \"deform\"\nseed = 3\n");
  EXPECT_EQ(ReadRunConfig(folder.path(), RunOf({{"system", "deform"}})).at("seed"), 3);
  ExpectError(
      [&] {
        ReadRunConfig(folder.path(), RunOf({{"system", "sketch"}}));
      },
      "resolved.toml is the config of a run of 'deform', but manifest.json next to it is of a run of 'sketch'");
  WriteFileAtomically(ResolvedConfig(folder.path()), "product = \"deform\"\n");
  EXPECT_NO_THROW(ReadRunConfig(folder.path(), RunOf({{"product", "deform"}})));
  WriteFileAtomically(ResolvedConfig(folder.path()), "system = 7\n");
  ExpectError([&] { ReadRunConfig(folder.path(), RunOf({})); }, "resolved.toml: system is 7, expected a text");
}

TEST(ReadRunConfig, RefusesOptionsThatWereEdited) {
  const testing::TempDir folder;
  Manifest run = RunOf({{"system", "deform"}});
  run.config = {{"system", "deform"}, {"seed", 3}, {"network", {{"width", 64}, {"rate", 1e-3}}}};
  const auto read = [&](const std::string& text) {
    WriteFileAtomically(ResolvedConfig(folder.path()), "system = \"deform\"\n" + text);
    return ReadRunConfig(folder.path(), run);
  };
  EXPECT_NO_THROW(read("seed = 3\nnetwork.width = 64\nnetwork.rate = 0.001\ndata.faces = \"elsewhere\"\n"));
  EXPECT_NO_THROW(read("seed = 3\nnetwork.width = 64\nnetwork.rate = 0.001\nnetwork.newer = 7\n"))
      << "an option that is newer than the run";
  ExpectError([&] { read("seed = 3\nnetwork.width = 32\nnetwork.rate = 0.001\n"); },
              "resolved.toml was edited: the run was trained with other options, which manifest.json in its folder "
              "holds (there):\n  network.width is 64 there and 32 now\n");
  ExpectError([&] { read("network.width = 64\nnetwork.rate = 0.001\n"); }, "seed is 3 there and missing now");
}

TEST(ReadFinishedRun, NamesBothTasksAndEveryOtherCause) {
  const testing::TempDir folder;
  const auto run = folder.path();
  ExpectError([&] { ReadFinishedRun(run); }, "is not a run folder");
  WriteFileAtomically(folder / "drawing.svg", "");
  ExpectError([&] { ReadFinishedRun(folder / "drawing.svg"); }, "drawing.svg is a file (expected a run folder");
  ExpectError([&] { ReadManifest(folder / "drawing.svg", "faces"); },
              "drawing.svg is a file (expected a folder of faces). Name the folder");
  WriteManifest(run, RunOf({{"system", "deform"}}));
  ExpectError([&] { ReadFinishedRun(run, "sketch"); },
              "this is a run of the task 'deform' (expected a run of 'sketch')");
  ExpectError([&] { ReadFinishedRun(run, "deform"); }, "resolved.toml --out " + run.string() + " --resume");
  MakeDirectory(run / "best");
  WriteFileAtomically(BestWeights(run), "weights");
  Manifest manifest = RunOf({{"system", "deform"}});
  manifest.checksums[kBestFile] = Sha256("weights");
  WriteManifest(run, manifest);
  EXPECT_EQ(SystemOf(ReadFinishedRun(run, "deform")), "deform");
  EXPECT_EQ(SystemOf(ReadFinishedRun(run)), "deform");
  WriteFileAtomically(BestWeights(run), "other weights");
  ExpectError([&] { ReadFinishedRun(run); }, "model.safetensors");
}

}  // namespace
}  // namespace daumier
