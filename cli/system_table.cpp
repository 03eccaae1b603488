#include "cli/system_table.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "core/training.h"
#include "core/weights_folder.h"
#include "systems/deform/system.h"
#include "systems/portrait/system.h"
#include "systems/sketch/system.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace daumier::cli {

const std::vector<systems::System>& Systems() {
  static const std::vector<systems::System> table = [] {
    std::vector<systems::System> rows = sketch::SketchSystems();
    rows.push_back(deform::DeformSystem());
    for (systems::System& system : portrait::PortraitSystems()) rows.push_back(std::move(system));
    return rows;
  }();
  return table;
}

const systems::System& SystemNamed(std::string_view name) {
  const auto found = std::ranges::find(Systems(), name, &systems::System::name);
  if (found != Systems().end()) return *found;
  std::vector<std::string_view> names;
  for (const systems::System& system : Systems()) names.push_back(system.name);
  throw UsageError(fmt::format("there is no task '{}' (expected {})", name, fmt::join(names, ", ")));
}

const systems::System& SystemOfConfig(const Json& config) {
  return SystemNamed(daumier::SystemOfConfig(config, "the config"));
}

namespace {

const systems::System& SystemIn(const std::filesystem::path& folder, const std::string& name) {
  try {
    return SystemNamed(name);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", folder.string(), error.what()));
  }
}

}  // namespace

const systems::System& SystemOfRun(const std::filesystem::path& run) {
  return SystemIn(run, SystemOf(ReadFinishedRun(run)));
}

const systems::System& SystemOfRunOrWeights(const std::filesystem::path& folder) {
  return IsWeightsFolder(folder) ? SystemIn(folder, SystemOf(ReadWeightsManifest(folder))) : SystemOfRun(folder);
}

}  // namespace daumier::cli
