#include "cli/edit_start.h"

#include "cli/rig_face.h"
#include "cli/shipped_landmarks.h"
#include "core/error.h"
#include "datasets/build/registered_faces.h"
#include "fitting/landmark_head.h"
#include "fitting/mesh_code.h"
#include "fitting/pictured_points.h"
#include "render/draw.h"

#include <algorithm>
#include <cmath>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

/// Height of a picture with landmarks in the sheet, pixels.
constexpr int kPictureHeight = 380;

void CheckOneStart(const EditStartArguments& arguments) {
  const auto given = [](const fs::path& path) { return path.empty() ? 0 : 1; };
  const int by_picture = given(arguments.landmarks) + given(arguments.picture) > 0 ? 1 : 0;
  if (given(arguments.face) + given(arguments.code) + by_picture > 1)
    throw UsageError(
        "--face, --code and a picture (--picture, --landmarks) each name the face that the edit begins with: give one "
        "of them");
  if (!arguments.mesh_landmarks.empty() && arguments.face.empty())
    throw UsageError("--mesh-landmarks are those of the mesh of --face, which is missing");
  if (!arguments.landmark_vertices.empty() && arguments.landmarks.empty())
    throw UsageError("--landmark-vertices are those of the points of --landmarks, which are missing");
}

geometry::Points VerticesOf(const fs::path& face, const fs::path& mesh_landmarks,
                            const faces::FaceTemplate& face_template) {
  if (!mesh_landmarks.empty()) {
    datasets::MeshInputs inputs;
    inputs.meshes = {face};
    inputs.landmarks = mesh_landmarks;
    return datasets::RegisterMesh(face_template, inputs).vertices;
  }
  return ReadFaceOf(face, face_template,
                    "Add --mesh-landmarks FILE with its 68 landmarks (docs/formats.md lists the forms), by which it is "
                    "registered first");
}

void Dot(render::Image& image, double x, double y, int radius, const render::Rgb& colour) {
  render::FillRectangle(image, int(std::lround(y)) - radius, int(std::lround(x)) - radius, 2 * radius + 1,
                        2 * radius + 1, colour);
}

/// The picture with the given landmarks in green and those of the face in red.
render::Image WithLandmarks(const fs::path& picture, const fitting::CodeLandmarkFit& fit,
                            const std::vector<fitting::PicturedPoint>& points) {
  render::Image image = render::ToRgb(render::ReadImage(picture));
  const double factor = double(kPictureHeight) / image.height;
  image = render::Resize(image, kPictureHeight, std::max(1, int(std::lround(factor * image.width))));
  for (size_t i = 0; i < points.size(); ++i) {
    Dot(image, factor * points[i].pixel.x(), factor * points[i].pixel.y(), 2, {40, 190, 60});
    Dot(image, factor * fit.pixels(Eigen::Index(i), 0), factor * fit.pixels(Eigen::Index(i), 1), 1, {220, 40, 40});
  }
  return image;
}

/// The points of the file, or the 68 landmarks that the shipped weights find in the picture.
std::vector<fitting::PicturedPoint> PointsOf(const EditStartArguments& arguments,
                                             const faces::FaceTemplate& face_template) {
  if (!arguments.landmarks.empty())
    return fitting::ReadPicturedPoints(face_template, arguments.landmarks, arguments.landmark_vertices);
  const ShippedLandmarks finder;
  const render::Image picture = render::ReadImage(arguments.picture);
  try {
    const std::vector<float> numbers = finder.detector().FindOne(picture).landmarks;
    const fitting::PicturePoints landmarks =
        Eigen::Map<const Eigen::Matrix<float, 68, 2, Eigen::RowMajor>>(numbers.data()).cast<double>();
    return fitting::PicturedLandmarks(face_template, landmarks);
  } catch (const Error& error) {
    throw Error(
        fmt::format("{}: {}. Name its 68 landmarks by --landmarks FILE", arguments.picture.string(), error.what()));
  }
}

EditStart StartOfLandmarks(const EditStartArguments& arguments, const fitting::CodeModel& model) {
  const fs::path& source = arguments.landmarks.empty() ? arguments.picture : arguments.landmarks;
  const std::vector<fitting::PicturedPoint> points = PointsOf(arguments, model.face_template());
  fitting::CodeLandmarkFit fit;
  try {
    fit = fitting::FitCodeToLandmarks(model, fitting::ContourPaths(model.face_template()), points);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", source.string(), error.what()));
  }
  const Eigen::Vector3d view_axis = fit.view.rotation.row(2);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = fit.view.rotation;
  EditStart start;
  start.face.name = source.stem().string();
  start.face.caption = "from landmarks";
  start.face.code = fit.code;
  start.face.vertices = model.Vertices(fit.code);
  start.face.record = {{"landmarks", source.filename().string()},
                       {"num_landmarks", points.size()},
                       {"mean_distance_px", fit.distances_px.mean()},
                       {"mean_distance_share", fit.distances_px.mean() / fit.eye_distance_px},
                       {"rounds", fit.rounds},
                       {"view",
                        {{"scale", fit.view.scale},
                         {"rotation", std::vector<double>(rotation.data(), rotation.data() + 9)},
                         {"shift", {fit.view.shift.x(), fit.view.shift.y()}},
                         {"yaw_degrees", std::atan2(-view_axis.x(), view_axis.z()) * 180 / M_PI}}}};
  if (arguments.picture.empty()) return start;
  start.pictures.push_back({WithLandmarks(arguments.picture, fit, points), "landmarks green, face red"});
  start.pictured = {arguments.picture, fit.view, fitting::LandmarksAmong(model.face_template(), points)};
  return start;
}

EditStart StartOfCode(const fs::path& code, const fitting::CodeModel& model) {
  const auto [path, name] = FileOfCode(code);
  const std::string file = path.string();
  const Json text = ReadJson(path);
  EditStart start;
  try {
    for (const Json& face : text.at("faces")) {
      if (face.at("name") != name && !(name == "start" && &face == &text.at("faces").front())) continue;
      const auto numbers = face.at("code").get<std::vector<double>>();
      DAUMIER_CHECK(std::ssize(numbers) == model.num_numbers(),
                    "{}: the code of '{}' has {} numbers, those of this model {}: name the model that it was made by",
                    file, name, numbers.size(), model.num_numbers());
      start.face = {face.at("name").get<std::string>(),
                    "start",
                    Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers)),
                    {},
                    {{"code", name}}};
      start.face.vertices = model.Vertices(start.face.code);
      return start;
    }
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: this is no edit.json of `daumier edit`: {}", file, TextOf(error)));
  }
  throw Error(fmt::format("{} has no face '{}'", file, name));
}

}  // namespace

CodePlace FileOfCode(const fs::path& code) {
  const std::string text = code.string();
  const size_t hash = text.rfind('#');
  if (hash == std::string::npos) return {code, "start"};
  return {text.substr(0, hash), text.substr(hash + 1)};
}

EditedFace FaceOf(const fs::path& face, const fs::path& mesh_landmarks, const fitting::CodeModel& model) {
  const geometry::Points target = VerticesOf(face, mesh_landmarks, model.face_template());
  fitting::MeshCode found = fitting::CodeOfMesh(model, target);
  const double mm_per_cm = faces::MillimetresPerCm(model.face_template());
  return {face.stem().string(),
          "face of the model",
          std::move(found.code),
          std::move(found.vertices),
          {{"face", face.filename().string()},
           {"mean_error_mm", found.mean_error_cm * mm_per_cm},
           {"seconds", found.seconds}}};
}

EditStart StartOf(const EditStartArguments& arguments, const fitting::CodeModel& model) {
  CheckOneStart(arguments);
  if (!arguments.landmarks.empty() || !arguments.picture.empty()) return StartOfLandmarks(arguments, model);
  if (!arguments.code.empty()) return StartOfCode(arguments.code, model);
  if (!arguments.face.empty()) return {FaceOf(arguments.face, arguments.mesh_landmarks, model)};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.num_numbers());
  return {{"mean", "mean face", zero, model.Vertices(zero)}};
}

}  // namespace daumier::cli
