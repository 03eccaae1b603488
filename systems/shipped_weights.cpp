#include "systems/shipped_weights.h"

#include "core/error.h"
#include "core/program_folder.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "systems/predict_inputs.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceVariable = "DAUMIER_WEIGHTS";

/// "landmarks, portrait (in /opt/weights)", or where nothing was found.
std::string TextOfShipped(std::span<const ShippedWeights> shipped, std::span<const fs::path> places) {
  if (shipped.empty()) {
    std::vector<std::string> names;
    for (const fs::path& place : places) names.push_back(place.string());
    return fmt::format("no weights are there; looked in {}. Set {} to the folder that holds them",
                       names.empty() ? "no folder" : fmt::format("{}", fmt::join(names, ", ")), kPlaceVariable);
  }
  std::vector<std::string> names;
  for (const ShippedWeights& weights : shipped) names.push_back(weights.name());
  return fmt::format("there are {} in {}", fmt::join(names, ", "), shipped.front().directory.parent_path().string());
}

/// Whether the system reads an input: a file by its extension, a folder by a file in it.
bool Reads(const System& system, const fs::path& input) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) return IsInputFile(system, input);
  return std::ranges::any_of(fs::directory_iterator(input),
                             [&](const fs::directory_entry& entry) { return IsInputFile(system, entry.path()); });
}

}  // namespace

std::vector<fs::path> WeightsPlaces() {
  if (const char* const place = std::getenv(kPlaceVariable); place != nullptr && *place != '\0') return {place};
  std::vector<fs::path> places;
  NearestAbove(ProgramFolder(), [&](const fs::path& here) {
    places.push_back(here / "weights");
    places.push_back(here / "share/daumier/weights");
    return false;
  });
  return places;
}

std::vector<ShippedWeights> ListWeights(std::span<const fs::path> places) {
  std::vector<ShippedWeights> shipped;
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (!fs::is_directory(place, ignored)) continue;
    for (const auto& entry : fs::directory_iterator(place)) {
      if (IsWeightsFolder(entry.path()))
        shipped.push_back({entry.path(), SystemOf(ReadManifest(entry.path(), kWeightsKind))});
      else
        CheckNotDamaged(entry.path());
    }
    if (!shipped.empty()) break;
  }
  std::ranges::sort(shipped, {}, &ShippedWeights::directory);
  return shipped;
}

fs::path WeightsNamed(const std::string& name, std::span<const ShippedWeights> shipped,
                      std::span<const fs::path> places) {
  if (IsWeightsFolder(name)) return name;
  CheckNotDamaged(name);
  const auto found = std::ranges::find(shipped, name, &ShippedWeights::name);
  if (found != shipped.end()) return found->directory;
  throw UsageError(fmt::format("there are no weights '{}' ({})", name, TextOfShipped(shipped, places)));
}

fs::path WeightsFor(std::span<const fs::path> inputs, std::span<const System> systems,
                    std::span<const ShippedWeights> shipped, std::span<const fs::path> places) {
  const ShippedWeights* best = nullptr;
  int best_rank = 0;
  const fs::path* unread = nullptr;  // By the weights that read the most inputs.
  size_t most_read = 0;
  for (const ShippedWeights& weights : shipped) {
    const auto system = std::ranges::find(systems, weights.system, &System::name);
    if (system == systems.end() || system->open == nullptr) continue;  // A face model, or of a newer version.
    const auto not_read =
        std::ranges::find_if_not(inputs, [&](const fs::path& input) { return Reads(*system, input); });
    const auto num_read = size_t(not_read - inputs.begin());
    if (not_read != inputs.end()) {
      if (unread == nullptr || num_read > most_read) unread = &*not_read, most_read = num_read;
    } else if (best == nullptr || system->shipped_rank > best_rank) {
      best = &weights;
      best_rank = system->shipped_rank;
    }
  }
  if (best != nullptr) return best->directory;
  const std::string input = unread != nullptr ? unread->string() : inputs.empty() ? "" : inputs.front().string();
  throw UsageError(fmt::format(
      "no shipped weights read {} ({}). Name a run that does: daumier predict RUN INPUT... --out DIR, or a picture",
      input, TextOfShipped(shipped, places)));
}

}  // namespace daumier::systems
