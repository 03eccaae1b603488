#include "c_api/places.h"

#include "core/error.h"
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
  return systems::WeightsNamed(name, systems::ListWeights(places), places);
}

fs::path ModelNamed(const char* name) {
  return name == nullptr ? deform::ShippedModel() : FolderNamed(name);
}

}  // namespace daumier::c_api
