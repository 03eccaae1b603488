#include "systems/sketch/stroke_network.h"

#include "export/torch_runner.h"
#include "render/draw.h"
#include "render/read_drawing.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/train/export.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"

namespace daumier::sketch {
namespace {

SketchPredictor OpenStrokeNetwork(const std::filesystem::path& run) {
  return {ReadSketchRunFolder(run),
          std::make_shared<exporting::TorchRunner>(exporting::NetworkOf(DescribeSketchExport(run)), torch::kCPU),
          nullptr,
          {.framing = "keep", .refine = false}};
}

torch::Tensor SketchTensor(const std::vector<render::Stroke>& strokes, int resolution) {
  return torch::tensor(InkOf(strokes, resolution)).view({1, 1, resolution, resolution});
}

torch::Tensor TrainingRaster(int resolution) {
  const render::Image image = render::RasteriseStrokes(fitting::Circles(), resolution);
  const auto grey = torch::tensor(std::vector<float>(image.pixels.begin(), image.pixels.end()));
  return (1 - grey / 255).view({1, 1, resolution, resolution});
}

TEST(InkOf, IsTheTrainingRaster) {
  const auto sketch = SketchTensor(fitting::Circles(), 128);
  EXPECT_EQ(sketch.sizes().vec(), (std::vector<int64_t>{1, 1, 128, 128}));
  EXPECT_TRUE(torch::allclose(sketch, TrainingRaster(128), 0, 1e-6));
}

TEST(InkOf, OfATracedTrainingRasterIsTheRaster) {
  const testing::TempDir folder;
  render::WriteImage(folder / "face.png", render::RasteriseStrokes(fitting::Circles(), 512));
  const render::Drawing traced = render::ReadDrawings(folder / "face.png")[0];
  const auto sketch = SketchTensor(render::MapToCanvas(traced.strokes, SheetPlacement(traced)), 64);
  EXPECT_LT((sketch - TrainingRaster(64)).abs().mean().item<double>(), 0.03);
}

TEST(TrainedStrokeNetwork, PredictsAsTheNetwork) {
  const testing::TempDir folder;
  auto network = testing::WriteSketchRun(folder.path());
  const SketchPredictor predictor = OpenStrokeNetwork(folder.path());
  auto other = fitting::Circles();
  other.pop_back();
  const auto faces = predictor.FromStrokes({fitting::Circles(), other});
  ASSERT_EQ(faces.size(), 2u);
  const at::NoGradGuard no_grad;
  const auto coefficients =
      network->forward({torch::cat({SketchTensor(fitting::Circles(), 32), SketchTensor(other, 32)}), {}, {}});
  const auto vertices = network->Decode(coefficients);
  ASSERT_EQ(int64_t(faces[1].vertices.size()), vertices.size(1));
  for (int face = 0; face < 2; ++face) {
    const fitting::PredictedFace& found = faces[size_t(face)];
    for (const int i : {0, 7, 500}) EXPECT_NEAR(found.vertices[size_t(i)], vertices[face][i].item<float>(), 1e-4);
    EXPECT_NEAR(found.u[2], coefficients.u[face][2].item<float>(), 1e-5);
    EXPECT_NEAR(found.v[1], coefficients.v[face][1].item<float>(), 1e-5);
  }
  EXPECT_TRUE(predictor.FromStrokes({}).empty());
}

TEST(TrainedStrokeNetwork, EveryKindOfNetworkIsGivenWhatItReads) {
  for (const auto& [kind, options] : testing::SmallSketchNetworks()) {
    const testing::TempDir folder;
    testing::WriteSketchRun(folder.path(), kind);
    const SketchPredictor predictor = OpenStrokeNetwork(folder.path());
    const fitting::PredictedFace face = predictor.FromStrokes({fitting::Circles()}).front();
    EXPECT_TRUE(Eigen::Map<const Eigen::VectorXf>(face.vertices.data(), Eigen::Index(face.vertices.size())).allFinite())
        << kind;
    EXPECT_EQ(face.u.size(), 6) << kind;
  }
}

TEST(TrainedStrokeNetwork, ASketchWithoutLengthHasNoPoints) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder.path(), "points");
  const SketchPredictor predictor = OpenStrokeNetwork(folder.path());
  testing::ExpectError([&] { predictor.FromStrokes({{{0, {{5, 5}}}}}); }, "");
}

TEST(TrainedStrokeNetwork, SeesTheCurvesOfTheTrainingSketches) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder.path());
  const SketchPredictor predictor = OpenStrokeNetwork(folder.path());
  const fitting::PredictedFace face = predictor.FromStrokes({fitting::Circles()}).front();
  const auto curves = predictor.CurvesOf(face);
  ASSERT_EQ(curves.size(), predictor.run().feature_curves.size());
  EXPECT_EQ(curves[0].points.size(), size_t(predictor.curves().num_points()));
  EXPECT_EQ(curves[0].points[0][1], fitting::Project(predictor.curves(), face.vertices)[1]);
}

}  // namespace
}  // namespace daumier::sketch
