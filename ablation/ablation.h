#pragma once
#include "ablation/config.h"
#include "ablation/runs.h"
#include "ablation/task.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::ablation {

/// Something that an ablation does, in the order in which it does it.
struct AblationStep {
  std::string row, split;
  uint64_t seed;
  RowState state;
};

/// What an ablation would do: seeds first to last, of each its splits first to last, of each its rows in WorkingOrder,
/// so that the first seed has its whole table before the next is begun. `only`: those rows and what they need.
/// @throws UsageError as AblationRuns, and if a run is there that has another config or other data.
std::vector<AblationStep> PlanAblation(const Ablation& ablation, const AblationTask& task,
                                       const std::filesystem::path& directory,
                                       const std::vector<std::string>& only = {});

/// `daumier ablate`: trains and evaluates what PlanAblation lists and is not done, and writes after every row
/// table.json (train/ablation_table.h), table.md, curves.svg (validation errors), sheet.png (rows side by side, of the
/// first split and seed) and index.html, of all rows that are done. Returns the table. A row that fails does not stop
/// the others, but those that need it.
/// @throws UsageError as PlanAblation, before anything is trained. @throws Error at the end, naming the rows that
/// failed; if two rows were not measured on the same test faces; and on Ctrl-C, after a checkpoint, saying how to go
/// on.
Json RunAblation(const Ablation& ablation, const AblationTask& task, const std::filesystem::path& directory,
                 const std::vector<std::string>& only = {});

}  // namespace daumier::ablation
