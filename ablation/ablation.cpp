#include "ablation/ablation.h"

#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "ablation/report.h"

#include <algorithm>
#include <functional>
#include <set>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

using Place = AblationRuns::Place;

/// Every row that is asked for, seed by seed and split by split.
std::vector<Place> Places(const Ablation& ablation, const std::vector<int>& order) {
  std::vector<Place> places;
  for (const uint64_t seed : ablation.options.seeds)
    for (const std::string& split : ablation.options.splits)
      for (const int row : order) places.push_back({ablation.rows[size_t(row)], split, seed});
  return places;
}

/// @throws Error if Ctrl-C was pressed.
void StopHereIfInterrupted(const fs::path& directory) {
  DAUMIER_CHECK(!Interrupted(),
                "the ablation was stopped; what it has so far is in {}. Go on by the same command again",
                directory.string());
}

}  // namespace

std::vector<AblationStep> PlanAblation(const Ablation& ablation, const AblationTask& task, const fs::path& directory,
                                       const std::vector<std::string>& only) {
  const AblationRuns runs(ablation, task, directory);
  std::vector<AblationStep> steps;
  for (const Place& place : Places(ablation, WorkingOrder(ablation, task.references(), only)))
    steps.push_back({place.row.name(), place.split, place.seed, runs.State(place)});
  return steps;
}

Json RunAblation(const Ablation& ablation, const AblationTask& task, const fs::path& directory,
                 const std::vector<std::string>& only) {
  const std::vector<AblationStep> plan = PlanAblation(ablation, task, directory, only);
  const AblationRuns runs(ablation, task, directory);
  MakeDirectory(directory);
  std::vector<std::string> failures;
  std::set<std::pair<std::string, std::string>> failed;  // Place and row.
  size_t number = 0;
  Json table;
  for (const Place& place : Places(ablation, WorkingOrder(ablation, task.references(), only))) {
    ++number;
    if (runs.State(place) == RowState::kDone) continue;
    const std::string where = fmt::format("{} seed {}", place.split, place.seed);
    const std::vector<std::string> needed = NeededRows(place.row, task.references());
    const auto missing = std::find_if(needed.begin(), needed.end(), [&](const std::string& name) {
      return failed.count({where, name}) == 1;
    });
    if (missing != needed.end()) {
      failures.push_back(fmt::format("{}: it needs {}", place.Describe(), *missing));
      failed.insert({where, place.row.name()});
      continue;
    }
    log::Info("Row {} of {}: {}", number, plan.size(), place.Describe());
    try {
      runs.Train(place);
      StopHereIfInterrupted(directory);
      runs.Evaluate(place);
    } catch (const Error& error) {
      StopHereIfInterrupted(directory);
      log::Warn("Row {} failed: {}", place.Describe(), error.what());
      failures.push_back(fmt::format("{}: {}", place.Describe(), error.what()));
      failed.insert({where, place.row.name()});
      continue;
    }
    const bool in_sheet =
        place.split == ablation.options.splits.front() && place.seed == ablation.options.seeds.front();
    table = WriteAblationReport(ablation, task, runs, directory, in_sheet);
    StopHereIfInterrupted(directory);
  }
  if (table.is_null()) table = WriteAblationReport(ablation, task, runs, directory);
  DAUMIER_CHECK(failures.empty(), "{} of {} rows failed; the others are in {}:\n  {}", failures.size(), plan.size(),
                directory.string(), fmt::join(failures, "\n  "));
  return table;
}

}  // namespace daumier::ablation
