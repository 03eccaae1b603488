#include "systems/predict_files.h"

#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "render/read_drawing.h"
#include "render/svg.h"
#include "systems/prediction_folder.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <set>
#include <stop_token>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// Predicts the synthetic face. Refuses drawings of one stroke; a warning on those of two.
class FacePredictor : public Predictor {
 public:
  std::vector<FaceResult> Predict(std::span<const Input> inputs, const Task& task) const override {
    std::vector<FaceResult> results;
    for (const Input& input : inputs) {
      task.ThrowIfCancelled("stopped");
      task.Report(1, 1, "drawings");
      FaceResult result{.face_template = face_template_, .vertices = face_template_->neutral};
      if (const auto* drawing = std::get_if<render::Drawing>(&input)) {
        DAUMIER_CHECK(drawing->strokes.size() > 1, "no face was found");
        if (drawing->strokes.size() == 2) result.warnings.push_back("few strokes");
        result.drawn = result.curves = drawing->strokes;
        result.record = {{"strokes", drawing->strokes.size()}};
      }
      results.push_back(std::move(result));
    }
    return results;
  }

  std::shared_ptr<const faces::FaceTemplate> face_template() const override { return face_template_; }

 private:
  std::shared_ptr<const faces::FaceTemplate> face_template_ =
      std::make_shared<const faces::FaceTemplate>(testing::SyntheticFace());
};

/// Every stroke but the first is drawn around a face of its own, with that.
class SeparatingPredictor : public FacePredictor {
 public:
  std::vector<Input> Separate(Input input) const override {
    const auto& strokes = std::get<render::Drawing>(input).strokes;
    std::vector<Input> inputs;
    for (size_t i = 1; i < strokes.size(); ++i)
      inputs.emplace_back(render::Drawing{256, 256, {strokes[0], strokes[i], strokes[i]}});
    return inputs;
  }
};

/// The drawings of a file; of an OBJ its mesh.
std::vector<Input> ReadInputs(const fs::path& file) {
  if (file.extension() == ".obj") return {geometry::ReadObj(file)};
  std::vector<Input> inputs;
  for (render::Drawing& drawing : render::ReadDrawings(file)) inputs.emplace_back(std::move(drawing));
  return inputs;
}

class PredictFilesTest : public ::testing::Test {
 protected:
  PredictFilesTest() {
    system_.name = "portrait";
    system_.read_inputs = ReadInputs;
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.seed = 5;
    manifest.sources = {{{"name", "synthetic"}, {"licence", "CC0-1.0"}}};
    MakeDirectory(run());
    WriteManifest(run(), manifest);
  }

  fs::path run() const { return folder_ / "run"; }
  fs::path out() const { return folder_ / "out"; }

  /// An SVG of the first circles.
  fs::path Draw(const fs::path& name, size_t num_circles = 5) const {
    auto strokes = fitting::Circles();
    strokes.resize(num_circles);
    MakeDirectory((folder_ / name).parent_path());
    render::WriteSvg(folder_ / name, strokes, {"line"});
    return folder_ / name;
  }
  PredictionSummary Predict(const std::vector<fs::path>& files, const Task& task = {}, bool refine = true) const {
    const PredictionInputs inputs = ReadPredictionInputs(system_, files);
    return PredictFiles(system_, predictor_, run(), inputs, out(), {{"refine", refine}}, task);
  }
  Json Details() const { return ReadManifest(out(), "predictions").details; }
  std::set<std::string> Written() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(out())) names.insert(entry.path().filename().string());
    return names;
  }

  const testing::TempDir folder_;
  System system_;
  const FacePredictor predictor_;
};

TEST_F(PredictFilesTest, WritesMeshSheetAndStrokesOfADrawing) {
  const fs::path file = Draw("anna.svg");
  Predict({file});
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.mtl", "anna.obj", "anna.png", "anna.svg", "manifest.json"}));
  const geometry::PolygonMesh mesh = geometry::ReadObj(out() / "anna.obj");
  const geometry::Points& neutral = predictor_.face_template()->neutral;
  ASSERT_GT(mesh.vertices.rows(), neutral.rows()) << "a finished head";
  EXPECT_EQ(mesh.vertices.topRows(neutral.rows()), neutral);
  const render::Image sheet = render::ReadImage(out() / "anna.png");
  EXPECT_GT(sheet.width, 2 * sheet.height) << "input, front and side";
  const auto strokes = render::ReadSvg(out() / "anna.svg").strokes;
  ASSERT_EQ(strokes.size(), 5u);
  EXPECT_EQ(strokes[4].points, fitting::Circles()[4].points);
}

TEST_F(PredictFilesTest, AMeshHasNoStrokes) {
  const faces::FaceTemplate& face_template = *predictor_.face_template();
  geometry::WriteObj(folder_ / "anna.obj", geometry::TriangleMesh{face_template.neutral, face_template.triangles});
  Predict({folder_ / "anna.obj"});
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.mtl", "anna.obj", "anna.png", "manifest.json"}));
}

/// Finds something in a picture, but no face to make a mesh of.
class MarkPredictor : public Predictor {
 public:
  std::vector<FaceResult> Predict(std::span<const Input>, const Task&) const override {
    FaceResult result;
    result.pictures = {{render::Image(20, 30, 3), "marks"}};
    result.files = {{".pts", "marks\n"}};
    result.masks = {{"_mask.png", render::Image(4, 5, 1, 3)}};
    return {result};
  }
};

/// Finds a number alone.
class NumberPredictor : public Predictor {
 public:
  std::vector<FaceResult> Predict(std::span<const Input>, const Task&) const override {
    FaceResult result;
    result.files = {{".json", "7\n"}};
    return {result};
  }
};

TEST_F(PredictFilesTest, AResultWithNothingToShowHasNoPicture) {
  System system = system_;
  system.result_files = {".json"};
  const PredictionInputs inputs = ReadPredictionInputs(system, {Draw("anna.svg")});
  PredictFiles(system, NumberPredictor(), run(), inputs, out(), Json::object());
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.json", "manifest.json"}));
}

TEST_F(PredictFilesTest, AResultWithoutAMeshIsASheetWithItsOwnFiles) {
  System system = system_;
  system.result_files = {".png", ".pts", "_mask.png"};
  const PredictionInputs inputs = ReadPredictionInputs(system, {Draw("anna.svg")});
  PredictFiles(system, MarkPredictor(), run(), inputs, out(), Json::object());
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.png", "anna.pts", "anna_mask.png", "manifest.json"}));
  EXPECT_EQ(ReadFile(out() / "anna.pts"), "marks\n");
  EXPECT_EQ(render::ReadImage(out() / "anna_mask.png"), render::Image(4, 5, 1, 3));
  EXPECT_EQ(ReadManifest(out(), "predictions").checksums.size(), 3u);
}

TEST_F(PredictFilesTest, TheManifestHoldsSystemOptionsRunAndRecords) {
  Predict({Draw("anna.svg"), Draw("bert.svg", 3)});
  const Manifest manifest = ReadManifest(out(), "predictions");
  EXPECT_EQ(manifest.verb, "predict");
  EXPECT_EQ(manifest.config, Json({{"refine", true}}));
  EXPECT_EQ(manifest.seed, 5u);
  EXPECT_EQ(manifest.sources, ReadManifest(run(), "run").sources);
  EXPECT_EQ(manifest.details["system"], "portrait");
  EXPECT_EQ(manifest.details["run_data_hash"], DataHash(run()));
  EXPECT_EQ(manifest.details["drawings"]["anna"]["strokes"], 5);
  EXPECT_EQ(manifest.details["drawings"]["bert"]["strokes"], 3);
  EXPECT_EQ(manifest.details["drawings"]["bert"]["file"], "bert.svg");
  EXPECT_FALSE(manifest.details.contains(kUnfinishedFiles));
  EXPECT_EQ(manifest.checksums.size(), 8u);
  EXPECT_NO_THROW(VerifyChecksums(out(), manifest));
}

TEST_F(PredictFilesTest, ABadInputSpoilsOnlyItselfAndIsListed) {
  const fs::path good = Draw("anna.svg"), no_face = Draw("bert.svg", 1), later = Draw("carl.svg", 4);
  const PredictionSummary summary = Predict({good, no_face, folder_ / "absent.svg", later});
  EXPECT_EQ(summary.num_results, 2u);
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.mtl", "anna.obj", "anna.png", "anna.svg", "carl.mtl", "carl.obj",
                                              "carl.png", "carl.svg", "manifest.json"}));
  const Json failures = Details()["failures"];
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_EQ(failures[0]["file"], "absent.svg");
  EXPECT_EQ(failures[1], Json({{"file", "bert.svg"}, {"cause", "bert.svg: no face was found"}}));
  EXPECT_EQ(ReadFile(out() / "manifest.json").find(folder_.path().string()), std::string::npos) << "no path";
  EXPECT_NO_THROW(VerifyChecksums(out(), ReadManifest(out(), "predictions")));
  ExpectError([&] { ThrowIfFailed(summary, out()); },
              "2 of 4 inputs failed; the results of the others are in " + out().string() + ":\n  ");
  ExpectError([&] { ThrowIfFailed(summary, out()); }, no_face.string() + ": no face was found");
}

TEST_F(PredictFilesTest, WithoutAResultNothingIsWritten) {
  const fs::path bad = Draw("bert.svg", 1);
  const PredictionSummary one = Predict({bad}), two = Predict({bad, folder_ / "absent.svg"});
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_NO_THROW(ThrowIfFailed({3, {}}, out()));
  try {
    ThrowIfFailed(one, out());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), bad.string() + ": no face was found");
  }
  ExpectError([&] { ThrowIfFailed(two, out()); }, "2 of 2 inputs failed; nothing was written:\n  ");
}

TEST_F(PredictFilesTest, AFolderOfAnotherKindIsUnchanged) {
  const std::string before = ReadFile(run() / "manifest.json");
  const fs::path drawing = Draw("anna.svg");
  const PredictionInputs inputs = ReadPredictionInputs(system_, {drawing});
  ExpectError([&] { PredictFiles(system_, predictor_, run(), inputs, run(), {}); }, "it is a folder of run");
  EXPECT_EQ(ReadFile(run() / "manifest.json"), before);
  ExpectError([&] { PredictFiles(system_, predictor_, run(), inputs, drawing, {}); }, "is a file");
}

TEST_F(PredictFilesTest, PredictionsOfAnotherTaskAreUnchanged) {
  Predict({Draw("anna.svg")});
  const std::string before = ReadFile(out() / "manifest.json");
  const std::set<std::string> files = Written();
  System other = system_;
  other.name = "landmarks";
  const PredictionInputs inputs = ReadPredictionInputs(other, {Draw("bert.svg")});
  EXPECT_THROW(CheckPredictionFolder(other, out(), run(), inputs), UsageError);
  ExpectError([&] { PredictFiles(other, predictor_, run(), inputs, out(), {}); },
              "holds predictions of the task 'portrait', and these are of 'landmarks'");
  EXPECT_EQ(ReadFile(out() / "manifest.json"), before);
  EXPECT_EQ(Written(), files);
}

TEST_F(PredictFilesTest, AnInputIsNeverOverwritten) {
  const fs::path drawing = Draw("drawings/anna.svg");
  const std::string before = ReadFile(drawing);
  const PredictionInputs inputs = ReadPredictionInputs(system_, {drawing});
  ExpectError([&] { PredictFiles(system_, predictor_, run(), inputs, drawing.parent_path(), {}); }, "is not empty");
  Predict({Draw("bert.svg")});
  const fs::path inside = Draw("out/anna.svg");  // In a folder of predictions.
  ExpectError([&] { Predict({inside}); }, "lies in the folder to write");
  ExpectError([&] { Predict({drawing}); }, "anna.svg is not listed in the manifest of its folder");
  EXPECT_EQ(ReadFile(drawing), before);
  EXPECT_EQ(ReadFile(inside), before);
}

TEST_F(PredictFilesTest, EarlierResultsStayAndACorrectionByHandIsNotLost) {
  Predict({Draw("anna.svg"), Draw("carl.svg")});
  fs::remove(out() / "carl.obj");
  Predict({Draw("bert.svg")});
  const Manifest both = ReadManifest(out(), "predictions");
  EXPECT_EQ(both.checksums.size(), 11u);
  EXPECT_EQ(both.details["drawings"].size(), 3u);
  EXPECT_EQ(both.counts["drawings"], 3);
  EXPECT_NO_THROW(VerifyChecksums(out(), both));
  EXPECT_NO_THROW(Predict({folder_ / "anna.svg"}));
  Predict({folder_ / "anna.svg"}, {}, /*refine=*/false);
  const Json records = Details()["drawings"];
  EXPECT_EQ(records.size(), 3u);
  EXPECT_FALSE(records["anna"].contains("options")) << "those of the manifest";
  EXPECT_EQ(records["bert"]["options"], Json({{"refine", true}}));
  EXPECT_EQ(records["bert"]["run_data_hash"], DataHash(run()));
  EXPECT_EQ(records["bert"]["strokes"], 5);
  EXPECT_EQ(ReadManifest(out(), "predictions").checksums.size(), 11u);
  Draw("out/anna.svg", 2);
  ExpectError([&] { Predict({folder_ / "anna.svg"}); }, "anna.svg has changed since it was written");
}

TEST_F(PredictFilesTest, InputsThatThePredictorSeparatesAreNumbered) {
  const SeparatingPredictor predictor;
  const PredictionInputs inputs =
      SeparateInputs(predictor, ReadPredictionInputs(system_, {Draw("anna.svg", 3), Draw("bert.svg", 2)}));
  PredictFiles(system_, predictor, run(), inputs, out(), {});
  EXPECT_EQ(Written(), (std::set<std::string>{"anna_1.mtl", "anna_1.obj", "anna_1.png", "anna_1.svg", "anna_2.mtl",
                                              "anna_2.obj", "anna_2.png", "anna_2.svg", "bert.mtl", "bert.obj",
                                              "bert.png", "bert.svg", "manifest.json"}));
}

TEST_F(PredictFilesTest, ACancelledTaskKeepsWhatIsFinished) {
  const std::vector<fs::path> files{Draw("anna.svg"), Draw("bert.svg")};
  std::stop_source source;
  const auto stop_after_the_first = [&](const TaskProgress& progress) {
    if (progress.done == 1) source.request_stop();
  };
  ExpectError([&] { Predict(files, Task(source.get_token(), stop_after_the_first)); }, "stopped");
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.mtl", "anna.obj", "anna.png", "anna.svg", "manifest.json"}));
  EXPECT_EQ(Details()["drawings"].size(), 1u);
  EXPECT_EQ(Predict(files).num_results, 2u);
}

TEST_F(PredictFilesTest, AKilledPredictionCanBeRunAgain) {
  const std::vector<fs::path> files{Draw("anna.svg"), Draw("bert.svg")};
  Predict(files);
  // What a program leaves that is killed behind the first file of bert.
  Manifest manifest = ReadManifest(out(), "predictions");
  for (const char* file : {"bert.mtl", "bert.obj", "bert.png", "bert.svg"}) manifest.checksums.erase(file);
  manifest.details[kUnfinishedFiles] = {"bert.mtl", "bert.obj", "bert.png", "bert.svg"};
  WriteManifest(out(), manifest);
  WriteFileAtomically(out() / "bert.obj", "half");
  Predict({files[0]});
  EXPECT_EQ(Details()[kUnfinishedFiles].size(), 4u) << "of other inputs they stay";
  EXPECT_EQ(Predict(files).num_results, 2u);
  EXPECT_FALSE(Details().contains(kUnfinishedFiles));
  EXPECT_EQ(ReadManifest(out(), "predictions").checksums.size(), 8u);
}

TEST_F(PredictFilesTest, ReportsTheInputsAndNothingOfOneOfThem) {
  std::vector<std::string> reports;
  const auto note = [&](const TaskProgress& progress) {
    reports.push_back(fmt::format("{}/{} {}", progress.done, progress.total, progress.unit));
  };
  Predict({Draw("anna.svg"), Draw("bert.svg")}, Task({}, note));
  EXPECT_EQ(reports, (std::vector<std::string>{"0/2 inputs", "1/2 inputs", "2/2 inputs"}));
}

TEST_F(PredictFilesTest, StoppedBeforeTheFirstNothingIsWritten) {
  std::stop_source source;
  const auto stop = [&](const TaskProgress&) { source.request_stop(); };
  ExpectError([&] { Predict({Draw("anna.svg")}, Task(source.get_token(), stop)); },
              "stopped after 0 of 1 inputs; nothing was written");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(PredictFilesTest, WarningsOfAResultAreLogged) {
  testing::AllowWarnings();
  const int before = log::NumWarnings();
  Predict({Draw("anna.svg", 2), Draw("bert.svg")});
  EXPECT_EQ(log::NumWarnings(), before + 1);
}

}  // namespace
}  // namespace daumier::systems
