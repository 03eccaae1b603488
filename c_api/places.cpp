#include "c_api/places.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "systems/deform/open_code_model.h"
#include "systems/portrait/system.h"
#include "systems/sketch/system.h"

#include <algorithm>

namespace daumier::c_api {

namespace fs = std::filesystem;

const std::vector<systems::System>& Predictors() {
  static const std::vector<systems::System> table = [] {
    std::vector<systems::System> rows = sketch::SketchSystems();
    for (systems::System& system : portrait::PortraitSystems()) rows.push_back(std::move(system));
    std::erase_if(rows, [](const systems::System& system) { return system.open == nullptr; });
    return rows;
  }();
  return table;
}

fs::path FolderNamed(const char* name) {
  if (name == nullptr || *name == '\0') throw UsageError("the name of the weights is NULL or empty");
  std::error_code ignored;
  if (fs::exists(fs::path(name) / "manifest.json", ignored)) return name;
  const std::vector<fs::path> places = systems::WeightsPlaces();
  for (const fs::path& place : places)  // By its name alone: other weights there may be damaged.
    if (fs::path(name).filename() == name && IsWeightsFolder(place / name)) return place / name;
  return systems::WeightsNamed(name, systems::ListWeights(places), places);
}

fs::path FaceModelNamed(const char* name) {
  fs::path folder = ModelNamed(name);
  if (IsWeightsFolder(folder) && SystemOf(ReadWeightsManifest(folder)) == kFaceModelSystem) return folder;
  throw UsageError(fmt::format("{}: these are no weights of a face model", folder.string()));
}

fs::path ModelNamed(const char* name) {
  if (name != nullptr) return FolderNamed(name);
  const std::vector<fs::path> places = systems::WeightsPlaces();
  for (const fs::path& place : places)
    if (IsWeightsFolder(place / "face-ict")) return place / "face-ict";
  return deform::ShippedModel();
}

}  // namespace daumier::c_api
