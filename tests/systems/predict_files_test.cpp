#include "systems/predict_files.h"

#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "render/read_drawing.h"
#include "render/svg.h"
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

  const faces::FaceTemplate& face_template() const { return *face_template_; }

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
  void Predict(const std::vector<fs::path>& files, const Task& task = {}) const {
    PredictFiles(system_, predictor_, run(), files, out(), {{"refine", true}}, task);
  }
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
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.obj", "anna.png", "anna.svg", "manifest.json"}));
  const geometry::PolygonMesh mesh = geometry::ReadObj(out() / "anna.obj");
  EXPECT_EQ(mesh.vertices, predictor_.face_template().neutral);
  const render::Image sheet = render::ReadImage(out() / "anna.png");
  EXPECT_GT(sheet.width, 2 * sheet.height) << "input, front and side";
  const auto strokes = render::ReadSvg(out() / "anna.svg").strokes;
  ASSERT_EQ(strokes.size(), 5u);
  EXPECT_EQ(strokes[4].points, fitting::Circles()[4].points);
}

TEST_F(PredictFilesTest, AMeshHasNoStrokes) {
  const auto& face_template = predictor_.face_template();
  geometry::WriteObj(folder_ / "anna.obj", geometry::TriangleMesh{face_template.neutral, face_template.triangles});
  Predict({folder_ / "anna.obj"});
  EXPECT_EQ(Written(), (std::set<std::string>{"anna.obj", "anna.png", "manifest.json"}));
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
  EXPECT_EQ(manifest.checksums.size(), 6u);
  EXPECT_NO_THROW(VerifyChecksums(out(), manifest));
}

TEST_F(PredictFilesTest, InputsOfTheSameNameAreNumbered) {
  Predict({Draw("a/face.svg", 5), Draw("b/face.svg", 4), Draw("c/face.svg", 3)});
  const Json drawings = ReadManifest(out(), "predictions").details["drawings"];
  EXPECT_EQ(drawings["face"]["strokes"], 5);
  EXPECT_EQ(drawings["face-2"]["strokes"], 4);
  EXPECT_EQ(drawings["face-3"]["strokes"], 3);
  for (const char* const file : {"face.obj", "face-2.obj", "face-3.svg"}) EXPECT_EQ(Written().count(file), 1u) << file;
}

TEST_F(PredictFilesTest, AnInputThatFailsIsNamedAndNothingIsWritten) {
  const fs::path good = Draw("anna.svg"), bad = Draw("bert.svg", 1);
  ExpectError([&] { Predict({good, bad}); }, bad.string() + ": no face was found");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(PredictFilesTest, AFileThatCannotBeReadIsNamedAndNothingIsWritten) {
  const fs::path good = Draw("anna.svg");
  ExpectError([&] { Predict({good, folder_ / "absent.svg"}); }, "absent.svg");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(PredictFilesTest, AFolderOfAnotherKindIsUnchanged) {
  const std::string before = ReadFile(run() / "manifest.json");
  const fs::path drawing = Draw("anna.svg");
  ExpectError([&] { PredictFiles(system_, predictor_, run(), {drawing}, run(), {}); },
              "is a folder of run (expected a new one, or one of predictions)");
  EXPECT_EQ(ReadFile(run() / "manifest.json"), before);
  ExpectError([&] { PredictFiles(system_, predictor_, run(), {drawing}, drawing, {}); },
              "is a file (expected a folder)");
  Predict({drawing});
  EXPECT_NO_THROW(Predict({drawing}));
}

TEST_F(PredictFilesTest, InputsThatThePredictorSeparatesAreNumbered) {
  PredictFiles(system_, SeparatingPredictor(), run(), {Draw("anna.svg", 3), Draw("bert.svg", 2)}, out(), {});
  EXPECT_EQ(Written(), (std::set<std::string>{"anna_1.obj", "anna_1.png", "anna_1.svg", "anna_2.obj", "anna_2.png",
                                              "anna_2.svg", "bert.obj", "bert.png", "bert.svg", "manifest.json"}));
}

TEST_F(PredictFilesTest, ACancelledTaskWritesNothing) {
  const std::vector<fs::path> files{Draw("anna.svg"), Draw("bert.svg")};
  std::stop_source source;
  const auto stop_after_the_first = [&](const TaskProgress& progress) {
    if (progress.done == 1) source.request_stop();
  };
  EXPECT_THROW(Predict(files, Task(source.get_token(), stop_after_the_first)), Cancelled);
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
