#include "ablation/ablation.h"

#include "ablation/report.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "systems/training_library.h"

#include <optional>
#include <set>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

/// The rows `order`, seed by seed and split by split.
std::vector<AblationRuns::Cell> Cells(const Ablation& ablation, const std::vector<int>& order) {
  std::vector<AblationRuns::Cell> cells;
  for (const uint64_t seed : ablation.options.seeds)
    for (const std::string& split : ablation.options.splits)
      for (const int row : order) cells.push_back({ablation.rows[size_t(row)], split, seed});
  return cells;
}

void ThrowIfCancelled(const Task& task, const fs::path& directory) {
  task.ThrowIfCancelled("{}: the ablation was interrupted; its finished rows are saved. The same command resumes it",
                        directory.string());
}

/// Failed rows, and the rows that need one.
class Failures {
 public:
  void Add(const AblationRuns::Cell& cell, const std::string& why) {
    messages_.push_back(fmt::format("{}: {}", cell.Describe(), why));
    failed_.insert({Where(cell), cell.row.name()});
  }
  /// The first row that `cell` needs and that failed.
  std::optional<std::string> NeededBy(const AblationRuns::Cell& cell,
                                      const std::vector<std::string>& references) const {
    for (const std::string& name : NeededRows(cell.row, references))
      if (failed_.count({Where(cell), name}) == 1) return name;
    return std::nullopt;
  }
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::string Where(const AblationRuns::Cell& cell) { return fmt::format("{} seed {}", cell.split, cell.seed); }

  std::vector<std::string> messages_;
  std::set<std::pair<std::string, std::string>> failed_;  ///< Split and seed, row.
};

}  // namespace

std::vector<AblationStep> PlanAblation(const Ablation& ablation, const AblationSystem& system,
                                       const fs::path& directory, const std::vector<std::string>& only) {
  const AblationRuns runs(ablation, system, directory);
  std::vector<AblationStep> steps;
  for (const AblationRuns::Cell& cell : Cells(ablation, WorkingOrder(ablation, system.system.run_options, only)))
    steps.push_back({cell.row.name(), cell.split, cell.seed, runs.State(cell)});
  return steps;
}

Json RunAblation(const Ablation& ablation, const AblationSystem& system, const fs::path& directory,
                 const std::vector<std::string>& only, const Task& task) {
  const std::vector<std::string>& references = system.system.run_options;
  const std::vector<AblationStep> plan = PlanAblation(ablation, system, directory, only);
  const AblationRuns runs(ablation, system, directory);
  FolderCache databases;
  CheckOutputFolder(directory, systems::AblationOutput());
  MakeDirectory(directory);
  if (!fs::exists(directory / "manifest.json")) WriteManifest(directory, {.kind = "ablation", .verb = "ablate"});
  Failures failures;
  size_t number = 0;
  Json table;
  for (const AblationRuns::Cell& cell : Cells(ablation, WorkingOrder(ablation, references, only))) {
    ++number;
    if (runs.State(cell) == RowState::kDone) continue;
    if (const auto needed = failures.NeededBy(cell, references)) {
      failures.Add(cell, fmt::format("it needs {}", *needed));
      continue;
    }
    log::Info("Row {} of {}: {}", number, plan.size(), cell.Describe());
    try {
      runs.Train(cell, databases, task);
      ThrowIfCancelled(task, directory);
      runs.Evaluate(cell, databases, task);
    } catch (const std::exception& error) {  // Of LibTorch, JSON or the allocator, too: the other rows count.
      ThrowIfCancelled(task, directory);
      log::Warn("Row {} failed: {}", cell.Describe(), error.what());
      failures.Add(cell, error.what());
      continue;
    }
    const bool in_sheet = cell.split == ablation.options.splits.front() && cell.seed == ablation.options.seeds.front();
    table = WriteAblationReport(ablation, runs, system, directory, in_sheet ? RowSheet::kDraw : RowSheet::kKeep);
    ThrowIfCancelled(task, directory);
  }
  if (table.is_null()) table = WriteAblationReport(ablation, runs, system, directory);
  DAUMIER_CHECK(failures.messages().empty(), "{} of {} rows failed; the others are in {}:\n  {}",
                failures.messages().size(), plan.size(), directory.string(), fmt::join(failures.messages(), "\n  "));
  return table;
}

}  // namespace daumier::ablation
