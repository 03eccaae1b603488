#include "fitting/sketch_predictor.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"
#include "fitting/face_surface.h"
#include "geometry/obj.h"
#include "render/camera.h"
#include "render/draw.h"
#include "render/framing.h"
#include "render/read_drawing.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/svg.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <set>

namespace daumier::fitting {
namespace {

namespace fs = std::filesystem;
using render::Image;

constexpr int kPictureSide = 360;

Image SheetOf(const faces::FaceTemplate& face_template, const std::vector<render::Stroke>& strokes,
              const geometry::Points& face) {
  const render::RenderInput input = SurfaceOf(face_template, face);
  const auto frame = render::FrameOf(face);
  return render::MakeSheet(
      {{render::ToRgb(render::RasteriseStrokes(strokes, kPictureSide)), "sketch"},
       {RenderMesh(input, render::FrontalCamera(frame.centre, frame.half_height, kPictureSide)), "front"},
       {RenderMesh(input, render::SideCamera(frame.centre, frame.half_height, kPictureSide)), "side"}},
      3);
}

/// A drawing of a file, on the canvas.
struct NamedStrokes {
  std::string name;
  std::vector<render::Stroke> strokes;
};

std::vector<NamedStrokes> ReadAll(const std::vector<fs::path>& files, Framing framing) {
  std::set<std::string> taken;
  std::vector<NamedStrokes> all;
  for (const fs::path& file : files) {
    for (const render::Drawing& drawing : render::ReadDrawings(file)) {
      const std::string stem = file.stem().string();
      std::string name = stem;
      for (int copy = 2; !taken.insert(name).second; ++copy) name = fmt::format("{}-{}", stem, copy);
      try {
        all.push_back({name, OnCanvas(drawing, framing)});
      } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", file.string(), error.what()));
      }
    }
  }
  return all;
}

}  // namespace

torch::Tensor SketchTensor(const std::vector<render::Stroke>& strokes, int resolution) {
  const Image image = render::RasteriseStrokes(strokes, resolution);
  std::vector<float> ink(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), ink.begin(),
                 [](uint8_t grey) { return static_cast<float>(255 - grey) / 255.0f; });
  return torch::tensor(ink).view({1, 1, resolution, resolution});
}

std::vector<render::Stroke> OnCanvas(const render::Drawing& drawing, Framing framing) {
  if (framing == Framing::kFit) return render::FrameStrokes(drawing);
  const double side = std::max(drawing.width, drawing.height), scale = render::kSketchCanvas / side;
  std::vector<render::Stroke> strokes = drawing.strokes;
  for (render::Stroke& stroke : strokes) {
    for (auto& [x, y] : stroke.points) {
      x = static_cast<float>((x + 0.5 * (side - drawing.width)) * scale);
      y = static_cast<float>((y + 0.5 * (side - drawing.height)) * scale);
    }
  }
  return strokes;
}

SketchPredictor::SketchPredictor(const fs::path& run_directory) : run_(models::LoadSketchRun(run_directory)) {}

geometry::Points SketchPredictor::Predict(const torch::Tensor& sketch) {
  at::NoGradGuard no_grad;
  const auto vertices = run_.network->Decode(run_.network->forward({sketch, {}, {}}));
  return tensor::CopyToMatrix<double>(vertices.view({-1, 3}));
}

void PredictSketches(const fs::path& run_directory, const std::vector<fs::path>& files, const fs::path& out_directory,
                     Framing framing) {
  SketchPredictor predictor(run_directory);
  const std::vector<NamedStrokes> drawings = ReadAll(files, framing);
  const auto& run = predictor.run();
  Manifest manifest;
  manifest.kind = "predictions";
  manifest.verb = "predict";
  manifest.seed = run.manifest.seed;
  manifest.sources = run.manifest.sources;
  manifest.counts = {{"drawings", drawings.size()}};
  manifest.details = {{"run_data_hash", DataHash(run_directory)}};
  MakeDirectory(out_directory);
  for (const auto& [name, strokes] : drawings) {
    const geometry::Points face = predictor.Predict(SketchTensor(strokes, predictor.resolution()));
    const std::string mesh = name + ".obj", lines = name + ".svg", sheet = name + ".png";
    geometry::WriteObj(out_directory / mesh, {face, run.face_template.triangles});
    render::WriteSvg(out_directory / lines, strokes, {"line"});
    render::WriteImage(out_directory / sheet, SheetOf(run.face_template, strokes, face));
    for (const auto& file : {mesh, lines, sheet}) manifest.checksums[file] = Sha256OfFile(out_directory / file);
  }
  WriteManifest(out_directory, manifest);
}

}  // namespace daumier::fitting
