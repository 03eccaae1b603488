#include "fitting/sketch_predictor.h"

#include "core/files.h"
#include "core/manifest.h"
#include "geometry/obj.h"
#include "render/strokes.h"
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

double MeanDifference(const torch::Tensor& a, const torch::Tensor& b) {
  return (a - b).abs().mean().item<double>();
}

Image WithValues(Image image, const std::function<double(double)>& value) {
  for (uint8_t& pixel : image.pixels) pixel = static_cast<uint8_t>(value(pixel));
  return image;
}

TEST(SketchFromImage, TakesATrainingRasterAsItIs) {
  const auto sketch = SketchFromImage(render::RasteriseStrokes(Drawing(), 128), 128);
  EXPECT_EQ(sketch.sizes().vec(), (std::vector<int64_t>{1, 1, 128, 128}));
  EXPECT_LT(MeanDifference(sketch, TrainingRaster(128)), 0.005);
}

TEST(SketchFromImage, SizeInversionColourAndPaperMakeLittleDifference) {
  const Image large = render::RasteriseStrokes(Drawing(), 512);
  const auto expected = SketchFromImage(large, 64);
  EXPECT_LT(MeanDifference(expected, TrainingRaster(64)), 0.05);
  EXPECT_LT(MeanDifference(SketchFromImage(WithValues(large, [](double v) { return 255 - v; }), 64), expected), 1e-6);
  EXPECT_LT(MeanDifference(SketchFromImage(WithValues(large, [](double v) { return 90 + 0.5 * v; }), 64), expected),
            0.06);
  Image rgb(512, 512, 3);
  for (size_t i = 0; i < rgb.pixels.size(); ++i) rgb.pixels[i] = large.pixels[i / 3];
  EXPECT_LT(MeanDifference(SketchFromImage(rgb, 64), expected), 1e-6);
}

TEST(SketchFromImage, PadsWithPaperSoThatNothingIsStretched) {
  Image wide(32, 64, 1, 200);
  for (int row = 8; row < 24; ++row)
    for (int column = 24; column < 40; ++column) wide.at(row, column) = 0;
  const auto sketch = SketchFromImage(wide, 64)[0][0];
  EXPECT_EQ(sketch.sum().item<float>(), 16 * 16);
  EXPECT_EQ(sketch.slice(0, 24, 40).slice(1, 24, 40).sum().item<float>(), 16 * 16);
}

TEST(SketchFromImage, StrengthensFaintLinesAndDropsPaperGrain) {
  Image faint = WithValues(render::RasteriseStrokes(Drawing(), 64), [](double v) { return v < 128 ? 190 : 255; });
  EXPECT_GT(SketchFromImage(faint, 64).max().item<float>(), 0.7f);
  faint.at(0, 0) = 245;
  EXPECT_EQ(SketchFromImage(faint, 64)[0][0][0][0].item<float>(), 0.0f);
}

TEST(SketchFromImage, RefusesPicturesWithoutLines) {
  ExpectError([] { SketchFromImage(Image(20, 20, 1), 64); }, "holds no lines");
  ExpectError([] { SketchFromImage(Image(), 64); }, "the picture is empty");
}

TEST(SketchPredictor, AnswersTheNetworksVertices) {
  const testing::TempDir folder;
  auto network = testing::WriteSketchRun(folder.path());
  SketchPredictor predictor(folder.path());
  const auto sketch = SketchFromImage(render::RasteriseStrokes(Drawing(), 100), predictor.resolution());
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
    render::WriteImage(folder / name, render::RasteriseStrokes(Drawing(), 80));
  }
  PredictSketches(folder / "run", {folder / "face.png", folder / "other/face.png"}, folder / "out");
  const Manifest manifest = ReadManifest(folder / "out", "predictions");
  EXPECT_NO_THROW(VerifyChecksums(folder / "out", manifest));
  EXPECT_EQ(manifest.checksums.size(), 4u);
  EXPECT_EQ(ReadFile(folder / "out/face.obj"), ReadFile(folder / "out/face-2.obj"));
  const auto mesh = geometry::ReadObj(folder / "out/face.obj");
  EXPECT_EQ(mesh.vertices.rows(), models::LoadSketchRun(folder / "run").face_template.num_vertices());
  EXPECT_GT(render::ReadImage(folder / "out/face.png").width, 1000);
}

TEST(PredictSketches, NamesTheBadPictureAndWritesNothing) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  render::WriteImage(folder / "blank.png", Image(30, 30, 1));
  ExpectError([&] { PredictSketches(folder / "run", {folder / "blank.png"}, folder / "out"); },
              "blank.png: the picture holds no lines");
  ExpectError([&] { PredictSketches(folder / "run", {folder / "none.png"}, folder / "out"); }, "none.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace daumier::fitting
