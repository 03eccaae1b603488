#include "fitting/sketch_predictor.h"

#include "core/files.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/read_drawing.h"
#include "render/strokes.h"
#include "render/svg.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"

namespace daumier::fitting {
namespace {

using render::Image;
using testing::ExpectError;

/// Lines as dense as those of a face.
std::vector<render::Stroke> Drawing() {
  std::vector<render::Stroke> strokes;
  for (const float radius : {20.0f, 40.0f, 60.0f, 80.0f, 100.0f}) {
    render::Stroke circle;
    for (int i = 0; i <= 60; ++i) {
      const float angle = 2.0f * 3.14159265f * i / 60.0f;
      circle.points.push_back({128 + radius * std::cos(angle), 128 + radius * std::sin(angle)});
    }
    strokes.push_back(circle);
  }
  return strokes;
}

torch::Tensor TrainingRaster(int resolution) {
  const Image image = render::RasteriseStrokes(Drawing(), resolution);
  const auto grey = torch::tensor(std::vector<float>(image.pixels.begin(), image.pixels.end()));
  return (1 - grey / 255).view({1, 1, resolution, resolution});
}

TEST(SketchTensor, IsTheTrainingRaster) {
  const auto sketch = SketchTensor(Drawing(), 128);
  EXPECT_EQ(sketch.sizes().vec(), (std::vector<int64_t>{1, 1, 128, 128}));
  EXPECT_TRUE(torch::allclose(sketch, TrainingRaster(128), 0, 1e-6));
}

TEST(OnCanvas, KeepsTheSheetOrFitsTheDrawing) {
  const render::Drawing wide{512, 256, {{0, {{100, 100}, {200, 150}}}}};
  const auto kept = OnCanvas(wide, Framing::kKeep);
  EXPECT_EQ(kept[0].points[0], (std::array<float, 2>{50, 114}));  // 128 pixels of paper above, then halved.
  EXPECT_EQ(kept[0].points[1], (std::array<float, 2>{100, 139}));
  const auto fitted = OnCanvas(wide, Framing::kFit);
  EXPECT_NEAR(0.5 * (fitted[0].points[0][0] + fitted[0].points[1][0]), 128, 1e-3);
  ExpectError([] { OnCanvas({10, 10, {}}, Framing::kFit); }, "");
}

TEST(OnCanvas, ATracedTrainingRasterComesBack) {
  const testing::TempDir folder;
  render::WriteImage(folder / "face.png", render::RasteriseStrokes(Drawing(), 512));
  const auto traced = SketchTensor(OnCanvas(render::ReadDrawings(folder / "face.png")[0], Framing::kKeep), 64);
  EXPECT_LT((traced - TrainingRaster(64)).abs().mean().item<double>(), 0.03);
}

TEST(SketchPredictor, AnswersTheNetworksVertices) {
  const testing::TempDir folder;
  auto network = testing::WriteSketchRun(folder.path());
  SketchPredictor predictor(folder.path());
  const auto sketch = SketchTensor(Drawing(), predictor.resolution());
  const auto face = predictor.Predict(sketch);
  const auto expected = network->Decode(network->forward(sketch)).view({-1, 3});
  ASSERT_EQ(face.rows(), network->num_vertices());
  for (const int vertex : {0, 7, 500}) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_FLOAT_EQ(face(vertex, axis), expected[vertex][axis].item<float>());
  }
}

TEST(PredictSketches, WritesAMeshAndASheetForEveryPicture) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  MakeDirectory(folder / "other");
  for (const auto* name : {"face.png", "other/face.png"}) {
    render::WriteImage(folder / name, render::RasteriseStrokes(Drawing(), 240));
  }
  PredictSketches(folder / "run", {folder / "face.png", folder / "other/face.png"}, folder / "out");
  const Manifest manifest = ReadManifest(folder / "out", "predictions");
  EXPECT_NO_THROW(VerifyChecksums(folder / "out", manifest));
  EXPECT_EQ(manifest.checksums.size(), 6u);
  EXPECT_EQ(ReadFile(folder / "out/face.obj"), ReadFile(folder / "out/face-2.obj"));
  const auto mesh = geometry::ReadObj(folder / "out/face.obj");
  EXPECT_EQ(mesh.vertices.rows(), models::LoadSketchRun(folder / "run").face_template.num_vertices());
  EXPECT_GT(render::ReadImage(folder / "out/face.png").width, 1000);
}

TEST(PredictSketches, ReadsStrokesDirectly) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  WriteFileAtomically(folder / "two.ndjson",
                      "{\"drawing\": [[[0, 90], [10, 200]], [[50, 60, 70], [5, 9, 5]]]}\n"
                      "{\"drawing\": [[[0, 255], [0, 255]]]}\n");
  render::WriteSvg(folder / "face.svg", Drawing(), {"line"});
  PredictSketches(folder / "run", {folder / "two.ndjson", folder / "face.svg"}, folder / "out", Framing::kKeep);
  for (const char* name : {"two.obj", "two-2.obj", "face.obj"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name));
  const auto strokes = render::ReadSvg(folder / "out/face.svg").strokes;
  ASSERT_EQ(strokes.size(), Drawing().size());
  EXPECT_EQ(strokes[2].points, Drawing()[2].points) << "the canvas is kept as it is";
}

TEST(PredictSketches, NamesTheBadPictureAndWritesNothing) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  render::WriteImage(folder / "blank.png", Image(30, 30, 1));
  ExpectError([&] { PredictSketches(folder / "run", {folder / "blank.png"}, folder / "out"); }, "blank.png");
  ExpectError([&] { PredictSketches(folder / "run", {folder / "none.png"}, folder / "out"); }, "none.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace daumier::fitting
