#include "systems/sketch/predictor.h"

#include "core/files.h"
#include "core/manifest.h"
#include "export/torch_runner.h"
#include "geometry/obj.h"
#include "render/draw.h"
#include "render/read_drawing.h"
#include "render/svg.h"
#include "systems/predict_files.h"
#include "systems/sketch/system.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/run.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

namespace daumier::sketch {
namespace {

using render::Image;
using testing::ExpectError;

SketchPredictor Open(const std::filesystem::path& run, const PredictOptions& options) {
  std::shared_ptr<const DrawingParser> parser;
  if (options.framing != "keep")
    parser = std::make_shared<const DrawingParser>(
        ParserNetworkOptions(), std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions()));
  return {ReadSketchRunFolder(run),
          std::make_shared<exporting::TorchRunner>(exporting::NetworkOf(DescribeSketchExport(run)), torch::kCPU),
          std::move(parser), options};
}

void PredictSketches(const std::filesystem::path& run, const std::vector<std::filesystem::path>& files,
                     const std::filesystem::path& out, const PredictOptions& options = {}) {
  PredictOptions all = options;
  const auto inputs = systems::ReadPredictionInputs(SketchSystem(), files);
  const auto summary = systems::PredictFiles(SketchSystem(), Open(run, options), run, inputs, out, ToJson(all));
  systems::ThrowIfFailed(summary, out);
}

TEST(TrainedSketchPredictor, WritesAMeshAndASheetForEveryPicture) {
  testing::AllowWarnings();  // The face of a hardly trained network fits no drawing.
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  MakeDirectory(folder / "other");
  for (const auto* name : {"face.png", "other/face.png"}) {
    render::WriteImage(folder / name, render::RasteriseStrokes(fitting::Circles(), 240));
  }
  PredictSketches(folder / "run", {folder / "face.png", folder / "other/face.png"}, folder / "out");
  const Manifest manifest = ReadManifest(folder / "out", "predictions");
  EXPECT_NO_THROW(VerifyChecksums(folder / "out", manifest));
  EXPECT_EQ(manifest.checksums.size(), 8u);
  EXPECT_EQ(geometry::ReadObj(folder / "out/face.obj").vertices, geometry::ReadObj(folder / "out/face-2.obj").vertices);
  const Json record = manifest.details.at("drawings").at("face-2");
  EXPECT_GT(record.at("frame").at("scale").get<double>(), 0);
  EXPECT_EQ(record.at("frame").at("shift").size(), 2u);
  EXPECT_EQ(record.at("states").at("view"), "front");
  EXPECT_GT(record.at("fit").at("residual_scale").get<double>(), 0);
  const auto mesh = geometry::ReadObj(folder / "out/face.obj");
  EXPECT_GT(mesh.vertices.rows(), LoadSketchRun(folder / "run").face_template.num_vertices());
  EXPECT_GT(render::ReadImage(folder / "out/face.png").width, 1000);
}

TEST(TrainedSketchPredictor, ReadsStrokesDirectly) {
  testing::AllowWarnings();  // The face of a hardly trained network fits no drawing.
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  WriteFileAtomically(folder / "two.ndjson",
                      "{\"drawing\": [[[0, 90], [10, 200]], [[50, 60, 70], [5, 9, 5]]]}\n"
                      "{\"drawing\": [[[0, 255], [0, 255]]]}\n");
  render::WriteSvg(folder / "face.svg", fitting::Circles(), {"line"});
  PredictSketches(folder / "run", {folder / "two.ndjson", folder / "face.svg"}, folder / "out", {.framing = "keep"});
  for (const char* name : {"two.obj", "two-2.obj", "face.obj"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name));
  const auto strokes = render::ReadSvg(folder / "out/face.svg").strokes;
  ASSERT_EQ(strokes.size(), fitting::Circles().size());
  EXPECT_EQ(strokes[2].points, fitting::Circles()[2].points) << "the canvas is kept as it is";
}

TEST(TrainedSketchPredictor, TheNetworksOwnFaceIsKeptIfWished) {
  testing::AllowWarnings();  // The face of a hardly trained network fits no drawing.
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  render::WriteSvg(folder / "face.svg", fitting::Circles(), {"line"});
  const auto mesh = [&](const std::string& out, const PredictOptions& options) {
    PredictSketches(folder / "run", {folder / "face.svg"}, folder / out, options);
    return geometry::ReadObj(folder / out / "face.obj").vertices;
  };
  const auto own = mesh("own", {.framing = "keep", .refine = false}), fitted = mesh("fitted", {}),
             not_fitted = mesh("not_fitted", {.fit = false});
  EXPECT_EQ(ReadManifest(folder / "own", "predictions").config.at("refine"), false);
  EXPECT_EQ(own.rows(), fitted.rows());
  EXPECT_NE(fitted, not_fitted);
  const Manifest manifest = ReadManifest(folder / "not_fitted", "predictions");
  EXPECT_EQ(manifest.config.at("fit"), false);
  EXPECT_FALSE(manifest.details.at("drawings").at("face").contains("fit"));
}

TEST(TrainedSketchPredictor, NamesTheBadPictureAndWritesNothing) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  render::WriteImage(folder / "blank.png", Image(30, 30, 1));
  ExpectError([&] { PredictSketches(folder / "run", {folder / "blank.png"}, folder / "out"); }, "blank.png");
  ExpectError([&] { PredictSketches(folder / "run", {folder / "none.png"}, folder / "out"); }, "none.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace daumier::sketch
