#pragma once
#include "ablation/runs.h"

namespace daumier::ablation {

enum class RowSheet { kDraw, kKeep };

/// Writes the finished rows of an ablation into its folder: table.json (returned; rows that trained also have
/// validation_at_equal_time, the least validation error within equal_seconds, the time of the split's shortest
/// training), table.md, curves.svg, curves_by_time.svg, sheet.png (of the first split and seed, with RowSheet::kDraw) and
/// index.html. Baselines are those of the first finished row. The sheet shows rows that are the result of a report with
/// predictions; without one the sheet stays unchanged.
/// @throws Error if two rows of a split and seed were not measured on the same test faces.
Json WriteAblationReport(const Ablation& ablation, const AblationRuns& runs, const AblationSystem& system,
                         const std::filesystem::path& directory, RowSheet row_sheet = RowSheet::kDraw);

}  // namespace daumier::ablation
