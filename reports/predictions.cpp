#include "reports/predictions.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/safetensors.h"
#include "geometry/coordinates.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace daumier::reports {
namespace {

namespace fs = std::filesystem;

constexpr int kEvenFaces = 16;
constexpr const char* kNumEyes = "num_eye_closing_triangles";

const std::vector<double>& ResultErrors(const MetricTable& table) {
  return FindRow(table, "").face_errors;
}

bool HaveSketches(const std::vector<FacePrediction>& faces) {
  const render::Image& first = faces.front().sketch;
  return first.height > 0 && std::all_of(faces.begin(), faces.end(), [&](const FacePrediction& face) {
           return face.sketch.height == first.height && face.sketch.width == first.width &&
                  face.sketch.channels == first.channels;
         });
}

void Check(const Predictions& predictions) {
  DAUMIER_CHECK(!predictions.faces.empty(), "there is no predicted face to write");
  const Eigen::Index num_vertices = predictions.faces.front().truth.rows();
  for (const FacePrediction& face : predictions.faces) {
    DAUMIER_CHECK(face.truth.rows() == num_vertices && face.prediction.rows() == num_vertices &&
                      face.error_mm.size() == num_vertices,
                  "face {} has {} true vertices, {} predicted ones and {} errors, expected {} each", face.face,
                  face.truth.rows(), face.prediction.rows(), face.error_mm.size(), num_vertices);
  }
}

void AddTriangles(SafetensorsWriter& writer, const std::string& name, const geometry::Triangles& triangles) {
  writer.Add<int32_t>(name, {triangles.rows(), 3}, {triangles.data(), size_t(triangles.size())});
}

geometry::Triangles TrianglesFrom(const SafetensorsFile& file, const std::string& name, Eigen::Index num_vertices) {
  const ArrayView& array = file.at(name);
  DAUMIER_CHECK(array.shape.size() == 2 && array.shape[1] == 3, "array {} does not have 3 columns", name);
  const geometry::Triangles triangles =
      Eigen::Map<const geometry::Triangles>(array.As<int32_t>().data(), array.shape[0], 3);
  DAUMIER_CHECK(triangles.size() == 0 || (triangles.minCoeff() >= 0 && triangles.maxCoeff() < num_vertices),
                "array {} names a vertex that is not one of {}", name, num_vertices);
  return triangles;
}

std::span<const float> ArrayOf(const SafetensorsFile& file, const std::string& name,
                               const std::vector<int64_t>& shape) {
  const ArrayView& array = file.at(name);
  DAUMIER_CHECK(array.shape == shape, "array {} has the shape {}, expected {}", name, Json(array.shape).dump(),
                Json(shape).dump());
  return array.As<float>();
}

void ReadSketches(const SafetensorsFile& file, std::vector<FacePrediction>& faces) {
  if (!file.contains("sketches")) return;
  const ArrayView& array = file.at("sketches");
  DAUMIER_CHECK(array.shape.size() == 4 && array.shape[0] == int64_t(faces.size()), "array sketches has the shape {}",
                Json(array.shape).dump());
  const uint8_t* pixels = array.As<uint8_t>().data();
  for (FacePrediction& face : faces) {
    face.sketch = render::Image(int(array.shape[1]), int(array.shape[2]), int(array.shape[3]));
    std::copy_n(pixels, face.sketch.pixels.size(), face.sketch.pixels.begin());
    pixels += face.sketch.pixels.size();
  }
}

Predictions Read(const fs::path& path) {
  const SafetensorsFile file(path);
  const std::span<const int32_t> indices = file.at("faces").As<int32_t>();
  const ArrayView& truth = file.at("truth");
  DAUMIER_CHECK(!indices.empty() && truth.shape.size() == 3, "array truth has the shape {}", Json(truth.shape).dump());
  const int64_t count = int64_t(indices.size()), num_vertices = truth.shape[1];
  const std::vector<int64_t> shape = {count, num_vertices, 3};
  const std::span<const float> true_values = ArrayOf(file, "truth", shape),
                               predicted = ArrayOf(file, "vertices", shape),
                               errors = ArrayOf(file, "error_mm", {count, num_vertices});
  Predictions predictions;
  predictions.surface.triangles = TrianglesFrom(file, "triangles", num_vertices);
  predictions.surface.closing_triangles = TrianglesFrom(file, "closing_triangles", num_vertices);
  const std::string& num_eyes = file.metadata().at(kNumEyes);
  std::from_chars(num_eyes.data(), num_eyes.data() + num_eyes.size(), predictions.surface.num_eye_closing_triangles);
  const size_t length = size_t(num_vertices);
  for (size_t i = 0; i < indices.size(); ++i) {
    FacePrediction& face = predictions.faces.emplace_back();
    face.face = indices[i];
    face.truth = geometry::PointsFrom(true_values.subspan(3 * length * i, 3 * length));
    face.prediction = geometry::PointsFrom(predicted.subspan(3 * length * i, 3 * length));
    face.error_mm = Eigen::Map<const Eigen::VectorXf>(&errors[length * i], num_vertices).cast<double>();
  }
  ReadSketches(file, predictions.faces);
  return predictions;
}

}  // namespace

double FacePrediction::mean_error_mm() const {
  std::vector<double> counted;
  std::copy_if(error_mm.begin(), error_mm.end(), std::back_inserter(counted), [](double e) { return !std::isnan(e); });
  return Mean(counted);
}

const FacePrediction& Predictions::at(int face) const {
  const auto found =
      std::find_if(faces.begin(), faces.end(), [&](const FacePrediction& one) { return one.face == face; });
  DAUMIER_CHECK(found != faces.end(), "there is no prediction of face {}", face);
  return *found;
}

std::vector<int> KeptFaces(const MetricTable& table) {
  const std::vector<int> even = EvenlySpaced(table.faces, kEvenFaces);
  std::set<int> kept(even.begin(), even.end());
  for (const ChosenFace& chosen : ChooseFaces(table.faces, ResultErrors(table))) kept.insert(chosen.face);
  return {kept.begin(), kept.end()};
}

std::vector<ReportSample> ChosenSamples(const MetricTable& table, const Predictions& predictions,
                                        const std::function<std::string(int face)>& describe) {
  std::vector<ReportSample> samples;
  for (const ChosenFace& chosen : ChooseFaces(table.faces, ResultErrors(table))) {
    const FacePrediction& face = predictions.at(chosen.face);
    samples.push_back({fmt::format("{}: {:.2f} mm; {}", chosen.title, face.mean_error_mm(), describe(chosen.face)),
                       face.sketch, face.truth, face.prediction, face.error_mm});
  }
  return samples;
}

std::string WritePredictions(const fs::path& file, const Predictions& predictions) {
  Check(predictions);
  const std::vector<FacePrediction>& faces = predictions.faces;
  const int64_t count = int64_t(faces.size()), num_vertices = faces.front().truth.rows();
  std::vector<int32_t> indices;
  std::vector<float> truth, vertices, errors;
  std::vector<uint8_t> sketches;
  for (const FacePrediction& face : faces) {
    indices.push_back(face.face);
    truth.insert(truth.end(), face.truth.data(), face.truth.data() + face.truth.size());
    vertices.insert(vertices.end(), face.prediction.data(), face.prediction.data() + face.prediction.size());
    errors.insert(errors.end(), face.error_mm.begin(), face.error_mm.end());
    sketches.insert(sketches.end(), face.sketch.pixels.begin(), face.sketch.pixels.end());
  }
  SafetensorsWriter writer;
  writer.Add<int32_t>("faces", {count}, indices);
  writer.Add<float>("truth", {count, num_vertices, 3}, truth);
  writer.Add<float>("vertices", {count, num_vertices, 3}, vertices);
  writer.Add<float>("error_mm", {count, num_vertices}, errors);
  if (HaveSketches(faces)) {
    const render::Image& first = faces.front().sketch;
    writer.Add<uint8_t>("sketches", {count, first.height, first.width, first.channels}, sketches);
  }
  AddTriangles(writer, "triangles", predictions.surface.triangles);
  AddTriangles(writer, "closing_triangles", predictions.surface.closing_triangles);
  writer.SetMetadata(kNumEyes, fmt::format("{}", predictions.surface.num_eye_closing_triangles));
  return writer.Write(file);
}

Predictions ReadPredictions(const fs::path& file) {
  try {
    return Read(file);
  } catch (const std::out_of_range&) {
    throw Error(fmt::format("{}: the metadata lack {}", file.string(), kNumEyes));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: not the predictions of a report: {}", file.string(), error.what()));
  }
}

}  // namespace daumier::reports
