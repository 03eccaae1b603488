#include "fitting/sketch_predictor.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "render/camera.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"

#include <torch/torch.h>

#include <algorithm>
#include <set>

namespace daumier::fitting {

namespace {

constexpr double kLumaRed = 0.299, kLumaGreen = 0.587, kLumaBlue = 0.114;  // ITU-R BT.601
constexpr int kLeastContrast = 32;                                         // of 255
constexpr int kPictureSize = 320;

render::Image ToGrey(const render::Image& image) {
  if (image.channels == 1) return image;
  render::Image grey(image.height, image.width, 1);
  for (size_t pixel = 0; pixel < grey.pixels.size(); ++pixel) {
    const uint8_t* const rgb = &image.pixels[3 * pixel];
    grey.pixels[pixel] = static_cast<uint8_t>(kLumaRed * rgb[0] + kLumaGreen * rgb[1] + kLumaBlue * rgb[2] + 0.5);
  }
  return grey;
}

/// The brightness of most of the picture.
uint8_t Median(std::vector<uint8_t> values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void WritePicture(const std::filesystem::path& file, const render::Image& drawing, const faces::FaceTemplate& face,
                  const geometry::Points& points) {
  const render::RenderInput input{.surface = {points, face.triangles},
                                  .closing_triangles = face.closing_triangles,
                                  .closing_colours = render::ClosingColours(
                                      static_cast<int>(face.closing_triangles.rows()), face.num_eye_closing_triangles)};
  const render::Frame frame = render::FrameOf(points);
  const int longer = std::max(drawing.height, drawing.width);
  const auto scaled = [&](int side) { return std::max(1, side * kPictureSize / longer); };
  render::WriteImage(
      file,
      render::MakeSheet(
          {{render::Resize(drawing, scaled(drawing.height), scaled(drawing.width)), "drawing"},
           {render::RenderMesh(input, render::FrontalCamera(frame.centre, frame.half_height, kPictureSize)), "front"},
           {render::RenderMesh(input, render::SideCamera(frame.centre, frame.half_height, kPictureSize)), "side"}},
          3));
}

}  // namespace

std::vector<float> InkOfDrawing(const render::Image& drawing, int resolution) {
  DAUMIER_CHECK(!drawing.pixels.empty(), "the drawing is empty");
  render::Image grey = ToGrey(drawing);
  const auto [darkest, lightest] = std::minmax_element(grey.pixels.begin(), grey.pixels.end());
  DAUMIER_CHECK(*lightest - *darkest >= kLeastContrast,
                "the drawing shows no lines: its darkest and lightest pixel are {} and {}", *darkest, *lightest);
  if (const int middle = (*darkest + *lightest) / 2; Median(grey.pixels) < middle) {
    for (uint8_t& value : grey.pixels) value = 255 - value;
  }
  const uint8_t paper = Median(grey.pixels), ink = *std::min_element(grey.pixels.begin(), grey.pixels.end());
  const int side = std::max(grey.height, grey.width);
  render::Image square(side, side, 1, paper);
  render::Paste(square, grey, (side - grey.height) / 2, (side - grey.width) / 2);
  const render::Image scaled = render::Resize(square, resolution, resolution);
  std::vector<float> result(scaled.pixels.size());
  std::transform(scaled.pixels.begin(), scaled.pixels.end(), result.begin(), [&](uint8_t value) {
    return std::clamp((static_cast<float>(paper) - value) / static_cast<float>(paper - ink), 0.0f, 1.0f);
  });
  return result;
}

geometry::Points PredictFace(models::SketchRun& run, const render::Image& drawing) {
  const torch::NoGradGuard no_grad;
  const int resolution = run.network->options().resolution;
  std::vector<float> ink = InkOfDrawing(drawing, resolution);
  const torch::Tensor vertices =
      run.network->Decode(run.network->forward(torch::from_blob(ink.data(), {1, 1, resolution, resolution})))
          .contiguous();
  using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const FloatPoints>(vertices.data_ptr<float>(), vertices.numel() / 3, 3).cast<double>();
}

void PredictSketches(const std::filesystem::path& run_directory, const std::vector<std::filesystem::path>& inputs,
                     const std::filesystem::path& out_directory) {
  std::vector<render::Image> drawings;
  std::set<std::string> names;
  for (const auto& input : inputs) {
    drawings.push_back(render::ReadImage(input));
    DAUMIER_CHECK(names.insert(input.stem().string()).second,
                  "two inputs are named {}; their results would overwrite each other", input.stem().string());
  }
  models::SketchRun run = models::LoadSketchRun(run_directory);
  MakeDirectory(out_directory);
  for (size_t i = 0; i < inputs.size(); ++i) {
    const geometry::Points points = PredictFace(run, drawings[i]);
    const std::string name = inputs[i].stem().string();
    geometry::WriteObj(out_directory / (name + ".obj"), {points, run.face_template.triangles});
    WritePicture(out_directory / (name + ".png"), drawings[i], run.face_template, points);
  }
}

}  // namespace daumier::fitting
