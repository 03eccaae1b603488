#include "c_api/calls.h"
#include "c_api/objects.h"
#include "c_api/places.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

using namespace daumier;
using namespace daumier::c_api;

namespace {

constexpr int64_t kMostPixels = int64_t(1) << 28;  // Of a picture.

render::Drawing DrawingOf(const daumier_strokes& strokes) {
  if (strokes.num_strokes < 1)
    throw UsageError(fmt::format("strokes has {} strokes (expected 1 or more)", strokes.num_strokes));
  const auto is_length = [](float value) { return std::isfinite(value) && value > 0; };
  if (!is_length(strokes.width) || !is_length(strokes.height))
    throw UsageError(fmt::format("the sheet is {} x {} (expected positive numbers)", strokes.width, strokes.height));
  Given(strokes.points, "strokes.points");
  Given(strokes.sizes, "strokes.sizes");
  render::Drawing drawing{.width = strokes.width, .height = strokes.height, .strokes = {}};
  const float* point = strokes.points;
  for (int32_t s = 0; s < strokes.num_strokes; ++s) {
    if (strokes.sizes[s] < 1)
      throw UsageError(fmt::format("strokes.sizes[{}] is {} (expected 1 or more)", s, strokes.sizes[s]));
    render::Stroke stroke;
    for (int32_t p = 0; p < strokes.sizes[s]; ++p, point += 2) {
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
        throw UsageError(fmt::format("point {} of stroke {} is not finite", p, s));
      stroke.points.push_back({point[0], point[1]});
    }
    drawing.strokes.push_back(std::move(stroke));
  }
  return drawing;
}

render::Image ImageOf(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels, size_t row_bytes) {
  Given(pixels, "pixels");
  if (width < 1 || height < 1 || int64_t(width) * height > kMostPixels)
    throw UsageError(fmt::format("the picture has {} x {} pixels (expected 1 x 1 or more, at most {} in all)", width,
                                 height, kMostPixels));
  if (channels != 1 && channels != 3 && channels != 4)
    throw UsageError(fmt::format("the picture has {} channels (expected 1, 3 or 4)", channels));
  if (row_bytes < size_t(width) * size_t(channels) || row_bytes > size_t(PTRDIFF_MAX) / size_t(height))
    throw UsageError(fmt::format("a row has {} bytes (expected {} or more)", row_bytes, int64_t(width) * channels));
  render::Image image(height, width, channels == 1 ? 1 : 3);
  for (int row = 0; row < height; ++row) {
    const uint8_t* from = pixels + size_t(row) * row_bytes;
    if (channels != 4) {
      std::memcpy(&image.at(row, 0), from, size_t(width) * size_t(channels));
      continue;
    }
    for (int column = 0; column < width; ++column, from += 4)
      for (int c = 0; c < 3; ++c)
        image.at(row, column, c) = uint8_t((from[c] * from[3] + 255 * (255 - from[3]) + 127) / 255);
  }
  return image;
}

/// The largest face of an input.
void Predict(const daumier_predictor& predictor, systems::Input input, daumier_face** face) {
  std::vector<systems::Input> inputs = predictor.predictor->Separate(std::move(input));
  std::vector<systems::FaceResult> results = predictor.predictor->Predict(std::span(inputs).first(1));
  auto made = std::make_unique<daumier_face>(daumier_face{std::move(results.front()), {}});
  made->record = made->result.record.dump(-1, ' ', false, Json::error_handler_t::replace);
  *face = made.release();
}

}  // namespace

daumier_status daumier_predictor_open(const char* weights, daumier_predictor** predictor) {
  return Call([&] {
    Given(predictor, "predictor");
    const std::filesystem::path folder = FolderNamed(weights);
    const std::string name =
        IsWeightsFolder(folder) ? SystemOf(ReadWeightsManifest(folder)) : SystemOf(ReadFinishedRun(folder));
    const auto system = std::ranges::find(Predictors(), name, &systems::System::name);
    if (system == Predictors().end()) {
      std::vector<std::string_view> names;
      for (const systems::System& other : Predictors()) names.push_back(other.name);
      throw UsageError(fmt::format("{}: the task '{}' predicts nothing (expected '{}')", folder.string(), name,
                                   fmt::join(names, "', '")));
    }
    const Json options = system->resolve_prediction(Json::object(), "daumier_predictor_open");
    *predictor = new daumier_predictor{*system, system->open(folder, Device{}, options)};
  });
}

void daumier_predictor_free(daumier_predictor* predictor) {
  delete predictor;
}

daumier_status daumier_predict_strokes(const daumier_predictor* predictor, const daumier_strokes* strokes,
                                       daumier_face** face) {
  return Call([&] {
    Given(face, "face");
    const daumier_predictor& opened = Given(predictor, "predictor");
    render::Drawing drawing = DrawingOf(Given(strokes, "strokes"));
    if (std::ranges::count(opened.system.input_extensions, ".svg") == 0)
      throw UsageError(fmt::format("the network of the task '{}' reads no strokes", opened.system.name));
    Predict(opened, std::move(drawing), face);
  });
}

daumier_status daumier_predict_pixels(const daumier_predictor* predictor, const uint8_t* pixels, int32_t width,
                                      int32_t height, int32_t channels, size_t row_bytes, daumier_face** face) {
  return Call([&] {
    Given(face, "face");
    Predict(Given(predictor, "predictor"), ImageOf(pixels, width, height, channels, row_bytes), face);
  });
}

daumier_status daumier_predict_file(const daumier_predictor* predictor, const char* path, daumier_face** face) {
  return Call([&] {
    Given(face, "face");
    const daumier_predictor& opened = Given(predictor, "predictor");
    const std::filesystem::path file = &Given(path, "path");
    std::error_code ignored;  // Of a pipe without a writer, reading would wait for ever.
    DAUMIER_CHECK(!std::filesystem::exists(file, ignored) || std::filesystem::is_regular_file(file, ignored),
                  "cannot read {}: not a file", path);
    Predict(opened, opened.system.read_inputs(file).at(0), face);
  });
}

void daumier_face_free(daumier_face* face) {
  delete face;
}

size_t daumier_face_num_vertices(const daumier_face* face) {
  return face == nullptr ? 0 : size_t(face->result.vertices.rows());
}

size_t daumier_face_num_triangles(const daumier_face* face) {
  return face == nullptr || !face->result.face_template ? 0 : size_t(face->result.face_template->triangles.rows());
}

daumier_status daumier_face_vertices(const daumier_face* face, float* xyz, size_t size) {
  return Call([&] { WritePoints(Given(face, "face").result.vertices, xyz, size, "xyz"); });
}

daumier_status daumier_face_triangles(const daumier_face* face, int32_t* corners, size_t size) {
  return Call([&] {
    const auto& face_template = Given(face, "face").result.face_template;
    WriteTriangles(face_template ? face_template->triangles : geometry::Triangles(0, 3), corners, size);
  });
}

daumier_status daumier_face_landmarks(const daumier_face* face, float* xyz, size_t size) {
  return Call([&] { WritePoints(Given(face, "face").result.landmarks, xyz, size, "xyz"); });
}

size_t daumier_face_num_warnings(const daumier_face* face) {
  return face == nullptr ? 0 : face->result.warnings.size();
}

const char* daumier_face_warning(const daumier_face* face, size_t index) {
  return index < daumier_face_num_warnings(face) ? face->result.warnings[index].c_str() : nullptr;
}

const char* daumier_face_record(const daumier_face* face) {
  return face == nullptr ? nullptr : face->record.c_str();
}
