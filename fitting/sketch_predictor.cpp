#include "fitting/sketch_predictor.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"
#include "fitting/face_surface.h"
#include "geometry/obj.h"
#include "render/camera.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <set>

namespace daumier::fitting {
namespace {

namespace fs = std::filesystem;
using render::Image;

/// Share of black below which a pixel counts as paper.
constexpr float kPaperGrain = 0.08f;
/// Ink of the inkiest fiftieth of a training sketch.
constexpr float kTypicalInk = 0.75f;
constexpr int kPictureSide = 360;

Image ToGrey(const Image& image) {
  if (image.channels == 1) return image;
  Image grey(image.height, image.width, 1);
  for (size_t pixel = 0; pixel < grey.pixels.size(); ++pixel) {
    const uint8_t* rgb = &image.pixels[3 * pixel];
    grey.pixels[pixel] = static_cast<uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
  }
  return grey;
}

/// The value below which `share` of the values lie.
template <class T>
T Quantile(std::vector<T> values, double share) {
  const auto rank = values.begin() + static_cast<int64_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

Image PaddedToSquare(const Image& image, uint8_t paper) {
  const int side = std::max(image.height, image.width);
  Image square(side, side, 1, paper);
  render::Paste(square, image, (side - image.height) / 2, (side - image.width) / 2);
  return square;
}

Image PictureOfSketch(const torch::Tensor& sketch) {
  Image image(static_cast<int>(sketch.size(2)), static_cast<int>(sketch.size(3)), 1);
  const float* ink = sketch.data_ptr<float>();
  std::transform(ink, ink + sketch.numel(), image.pixels.begin(),
                 [](float value) { return static_cast<uint8_t>(255.0f * (1.0f - value) + 0.5f); });
  return render::Resize(image, kPictureSide, kPictureSide);
}

Image SheetOf(const faces::FaceTemplate& face_template, const torch::Tensor& sketch, const geometry::Points& face) {
  const render::RenderInput input = SurfaceOf(face_template, face);
  const auto frame = render::FrameOf(face);
  return render::MakeSheet(
      {{PictureOfSketch(sketch), "sketch"},
       {RenderMesh(input, render::FrontalCamera(frame.centre, frame.half_height, kPictureSide)), "front"},
       {RenderMesh(input, render::SideCamera(frame.centre, frame.half_height, kPictureSide)), "side"}},
      3);
}

/// The stem of each picture, made unique.
std::vector<std::string> NamesOf(const std::vector<fs::path>& pictures) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const auto& picture : pictures) {
    const std::string stem = picture.stem().string();
    std::string name = stem;
    for (int copy = 2; !taken.insert(name).second; ++copy) name = fmt::format("{}-{}", stem, copy);
    names.push_back(name);
  }
  return names;
}

}  // namespace

torch::Tensor SketchFromImage(const Image& image, int resolution) {
  DAUMIER_CHECK(!image.pixels.empty(), "the picture is empty");
  Image grey = ToGrey(image);
  uint8_t paper = Quantile(grey.pixels, 0.5);
  if (paper < 128) {
    for (uint8_t& value : grey.pixels) value = static_cast<uint8_t>(255 - value);
    paper = static_cast<uint8_t>(255 - paper);
  }
  const Image small = render::Resize(PaddedToSquare(grey, paper), resolution, resolution);

  std::vector<float> ink(small.pixels.size());
  std::transform(small.pixels.begin(), small.pixels.end(), ink.begin(), [&](uint8_t value) {
    const float share = static_cast<float>(paper - value) / static_cast<float>(paper);
    return share < kPaperGrain ? 0.0f : share;
  });
  const float inkiest = *std::max_element(ink.begin(), ink.end());
  DAUMIER_CHECK(inkiest > 0, "the picture holds no lines; expected dark lines on light paper");
  const float typical = std::max(Quantile(ink, 0.98), inkiest * kPaperGrain);
  const float gain = std::max(1.0f, kTypicalInk / typical);
  for (float& value : ink) value = std::min(1.0f, gain * value);
  return torch::tensor(ink).view({1, 1, resolution, resolution});
}

SketchPredictor::SketchPredictor(const fs::path& run_directory) : run_(models::LoadSketchRun(run_directory)) {}

geometry::Points SketchPredictor::Predict(const torch::Tensor& sketch) {
  at::NoGradGuard no_grad;
  const auto vertices = run_.network->Decode(run_.network->forward(sketch));
  return tensor::CopyToMatrix<double>(vertices.view({-1, 3}));
}

void PredictSketches(const fs::path& run_directory, const std::vector<fs::path>& pictures,
                     const fs::path& out_directory) {
  SketchPredictor predictor(run_directory);
  std::vector<torch::Tensor> sketches;
  for (const auto& picture : pictures) {
    const Image image = render::ReadImage(picture);
    try {
      sketches.push_back(SketchFromImage(image, predictor.resolution()));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", picture.string(), error.what()));
    }
  }

  const auto& run = predictor.run();
  Manifest manifest;
  manifest.kind = "predictions";
  manifest.verb = "predict";
  manifest.seed = run.manifest.seed;
  manifest.sources = run.manifest.sources;
  manifest.counts = {{"pictures", pictures.size()}};
  manifest.details = {{"run_data_hash", DataHash(run_directory)}};
  MakeDirectory(out_directory);
  const auto names = NamesOf(pictures);
  for (size_t i = 0; i < pictures.size(); ++i) {
    const geometry::Points face = predictor.Predict(sketches[i]);
    const std::string mesh = names[i] + ".obj", sheet = names[i] + ".png";
    geometry::WriteObj(out_directory / mesh, {face, run.face_template.triangles});
    render::WriteImage(out_directory / sheet, SheetOf(run.face_template, sketches[i], face));
    for (const auto& name : {mesh, sheet}) manifest.checksums[name] = Sha256OfFile(out_directory / name);
  }
  WriteManifest(out_directory, manifest);
}

}  // namespace daumier::fitting
