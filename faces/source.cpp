#include "faces/source.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/weights_folder.h"
#include "faces/archive.h"
#include "faces/face_model_file.h"
#include "faces/ict.h"
#include "faces/import/bfm.h"
#include "faces/import/facescape.h"
#include "faces/import/facewarehouse.h"
#include "faces/import/flame.h"
#include "faces/import/mesh_folder.h"
#include "faces/makehuman.h"

namespace daumier::faces {

namespace {

namespace fs = std::filesystem;

AnnotationFile ReadAnnotation(const SourceOptions& options) {
  if (options.annotation.empty()) {
    throw UsageError(fmt::format(
        "source {} needs source.annotation: a JSON file that specifies at least landmarks and hairline of its topology "
        "(docs/annotation.md)",
        options.name));
  }
  return ParseAnnotationFile(ReadFile(options.annotation), options.annotation);
}

/// By the arrays of an .npz, which are not read.
std::optional<std::string> SourceOfArrays(const fs::path& file) {
  std::optional<std::string> source;
  const auto look = [&](const std::string& path) {
    if (path == "v_template.npy") source = "flame";
    if (path == "shape_bm_core.npy") source = "facescape";
    return false;
  };
  ForEachFile(file, look, [](const std::string&, std::string_view) {});
  return source;
}

std::optional<std::string> SourceOfFolder(const fs::path& folder) {
  if (IsWeightsFolder(folder)) {
    const Json details = ReadManifest(folder, kWeightsKind).details;
    return details.contains("source") ? std::optional(details.at("source").get<std::string>()) : std::nullopt;
  }
  const auto has = [&](const char* path) { return fs::exists(folder / path); };
  if (has("FaceXModel") || has("generic_neutral_mesh.obj")) return "ict";
  if (has("public/data/targets/targets.bin") || has("3dobjs/base.obj") || has("data/3dobjs/base.obj") ||
      has("makehuman/data/3dobjs/base.obj"))
    return "makehuman";
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename().string().starts_with("Tester_")) return "facewarehouse";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> RecognisedSource(const fs::path& path) {
  if (fs::is_directory(path)) return SourceOfFolder(path);
  const std::string extension = path.extension().string(), name = path.filename().string();
  if (extension == ".npz" && fs::exists(path)) return SourceOfArrays(path);
  if (extension == ".pkl") return "flame";
  if (extension == ".mat" || extension == ".h5") return "bfm";
  if (extension == ".tar" || extension == ".tgz" || extension == ".zip" || name.find(".tar.") != std::string::npos)
    return "ict";
  return std::nullopt;
}

std::variant<FaceModel, GivenFaces> LoadSource(const SourceOptions& options) {
  if (!options.path.empty() && IsWeightsFolder(options.path)) return ReadFaceModelWeights(options.path, options.name);
  if (options.name == "makehuman")
    return LoadMakeHuman(options.path.empty() ? DefaultMakeHumanFolder() : std::filesystem::path(options.path));
  if (options.path.empty()) {
    const char* const hint = options.name == "ict"
                                 ? "a checkout of ICT-FaceKit, its tar archive, or the shipped weights/face-ict"
                                 : "your own copy of it (docs/importers.md)";
    throw UsageError(fmt::format("source {} needs source.path: {}", options.name, hint));
  }
  if (options.name == "ict") return LoadIct(options.path);
  const AnnotationFile annotation = ReadAnnotation(options);
  if (options.name == "bfm") return LoadBfm(options.path, annotation);
  if (options.name == "flame") return LoadFlame(options.path, annotation);
  if (options.name == "facescape") return LoadFaceScape(options.path, annotation);
  if (options.name == "caricshop") return LoadCaricShop(options.path, annotation);
  if (options.name == "facewarehouse" || options.name == "facewarehouse_poses") {
    const auto set =
        options.name == "facewarehouse" ? FaceWarehouseSet::kBlendshapes : FaceWarehouseSet::kTrainingPoses;
    return LoadFaceWarehouse(options.path, options.template_mesh, set, annotation);
  }
  return LoadMeshFolder(options.path, annotation, options.person == "folder" ? PersonOf::kFolder : PersonOf::kFile,
                        options.licence);
}

FaceModel LoadFaceModel(const SourceOptions& options) {
  auto source = LoadSource(options);
  if (auto* model = std::get_if<FaceModel>(&source)) return std::move(*model);
  throw UsageError(fmt::format("source {} gives faces, not a model of which new ones are drawn", options.name));
}

}  // namespace daumier::faces
