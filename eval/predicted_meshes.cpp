#include "eval/predicted_meshes.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "faces/finished_head.h"
#include "faces/import/mesh_folder.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace daumier::eval {
namespace {

namespace fs = std::filesystem;

bool IsMeshName(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return (extension == ".obj" || extension == ".ply") && !IsSystemFile(file.filename());
}

constexpr const char* kPictureFromSheet = "picture_from_sheet";
constexpr const char* kFrameRepair =
    "Predict with `daumier predict ... --out`, or write {\"details\": {\"drawings\": {\"NAME\": {\"frame\": "
    "{\"scale\": S, \"shift\": [X, Y]}}}}} where canvas = S * sheet + (X, Y)";

/// `details.drawings` of a manifest of predictions, which need not be Daumier's own.
Json RecordsOfDrawings(const fs::path& file) {
  DAUMIER_CHECK(fs::exists(file), "{} is missing: it holds the frame of each drawing. {}", file.string(), kFrameRepair);
  const Json manifest = ReadJson(file);
  const auto details = manifest.is_object() ? manifest.find("details") : manifest.end();
  DAUMIER_CHECK(details != manifest.end() && details->is_object() && details->contains("drawings") &&
                    details->at("drawings").is_object(),
                "{} has no details.drawings, which hold the frame of each drawing. {}", file.string(), kFrameRepair);
  return details->at("drawings");
}

}  // namespace

std::map<std::string, fs::path> MeshesIn(const fs::path& folder) {
  DAUMIER_CHECK(fs::is_directory(folder), "{}: no such folder (expected one of meshes NAME.obj)", folder.string());
  std::map<std::string, fs::path> meshes;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() || !IsMeshName(entry.path())) continue;
    const auto [place, is_new] = meshes.emplace(entry.path().stem().string(), entry.path());
    DAUMIER_CHECK(is_new, "{} and {} are meshes of the same name. Remove one", place->second.string(),
                  entry.path().string());
  }
  DAUMIER_CHECK(!meshes.empty(), "{} holds no mesh (expected NAME.obj or NAME.ply)", folder.string());
  return meshes;
}

TemplateMeshReader::TemplateMeshReader(const faces::FaceTemplate& face_template)
    : num_vertices_(face_template.num_vertices()), num_head_vertices_(num_vertices_) {
  try {
    num_head_vertices_ = faces::FinishedHead(face_template).num_vertices();
  } catch (const Error&) {  // A template of an open surface of another kind: only its own vertices are read.
  }
}

geometry::Points TemplateMeshReader::Read(const fs::path& file) const {
  const geometry::Points vertices = faces::ReadMesh(file).vertices;
  DAUMIER_CHECK(
      vertices.rows() == num_vertices_ || vertices.rows() == num_head_vertices_,
      "{} has {} vertices (expected {} of the template{}). Name the template that it was predicted with: "
      "--template",
      file.string(), vertices.rows(), num_vertices_,
      num_head_vertices_ == num_vertices_ ? "" : fmt::format(", or {} of its finished head", num_head_vertices_));
  DAUMIER_CHECK(vertices.allFinite(), "{} has a vertex that is no finite number", file.string());
  return vertices.topRows(num_vertices_);
}

DrawnPredictions ReadDrawnPredictions(const fs::path& folder, std::span<const LabelledDrawing> drawings,
                                      const faces::FaceTemplate& face_template) {
  std::map<std::string, fs::path> meshes = MeshesIn(folder);
  const fs::path manifest = folder / "manifest.json";
  const Json records = RecordsOfDrawings(manifest);
  const TemplateMeshReader reader(face_template);
  DrawnPredictions predictions;
  for (const LabelledDrawing& drawing : drawings) {
    const auto mesh = meshes.find(drawing.name);
    const auto record = records.find(drawing.name);
    if (mesh == meshes.end()) {
      DAUMIER_CHECK(record == records.end(), "{} lists '{}', but {}.obj is missing. Predict it again",
                    manifest.string(), drawing.name, (folder / drawing.name).string());
      continue;
    }
    DAUMIER_CHECK(record != records.end() && record->is_object() && record->contains("frame"),
                  "{} has no frame of '{}'. {}", manifest.string(), drawing.name, kFrameRepair);
    try {
      const render::Placement frame = render::PlacementFromJson(record->at("frame"));
      DrawnPrediction& prediction = predictions.of_labelled[drawing.name] = {reader.Read(mesh->second), frame};
      if (record->contains(kPictureFromSheet))
        prediction.picture_from_sheet = render::HomographyFromJson(record->at(kPictureFromSheet));
    } catch (const Error& error) {
      const std::string cause = error.what();
      if (cause.starts_with(mesh->second.string())) throw;
      throw Error(fmt::format("{}: '{}': {}", manifest.string(), drawing.name, cause));
    }
    meshes.erase(mesh);
  }
  for (const auto& [name, file] : meshes) predictions.unlabelled.push_back(name);
  DAUMIER_CHECK(!predictions.of_labelled.empty(),
                "{}: none of the meshes ({}, ...) has the name of a labelled drawing ({}, ...). Rename them",
                folder.string(), predictions.unlabelled.front(), drawings.empty() ? "none" : drawings.front().name);
  return predictions;
}

}  // namespace daumier::eval
