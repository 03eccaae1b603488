#pragma once
#include "ablation/config.h"
#include "ablation/runs.h"
#include "core/task.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::ablation {

/// One unit of work of an ablation.
struct AblationStep {
  std::string row, split;
  uint64_t seed;
  RowState state;
};

/// The steps of an ablation: seeds first to last, of each its splits first to last, of each its rows in WorkingOrder,
/// so that the first seed has its whole table before the next one begins. `only`: those rows and what they need.
/// @throws UsageError as AblationRuns, and if an existing run has another config or other data.
std::vector<AblationStep> PlanAblation(const Ablation& ablation, const AblationSystem& system,
                                       const std::filesystem::path& directory,
                                       const std::vector<std::string>& only = {});

/// `daumier ablate`: trains and evaluates what PlanAblation lists and is not done, and writes after every row
/// table.json (ablation/table.h), table.md, curves.svg (validation errors), sheet.png (rows side by side, of the first
/// split and seed, drawn from the predictions of the reports) and index.html, of all rows that are done. Returns the
/// table. Each database is opened and verified once. A row that fails, by whatever exception, stops only those that
/// need it.
/// @throws UsageError as PlanAblation, before anything is trained. @throws Error at the end, naming the rows that
/// failed; if two rows were not measured on the same test faces. @throws Cancelled if the task is cancelled, after a
/// checkpoint; the same call resumes.
Json RunAblation(const Ablation& ablation, const AblationSystem& system, const std::filesystem::path& directory,
                 const std::vector<std::string>& only = {}, const Task& task = {});

}  // namespace daumier::ablation
