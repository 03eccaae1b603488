#pragma once
#include "reports/metric_table.h"

#include <string>
#include <vector>

/// table.json of an ablation (ablation/table.h, docs/formats.md) for people.
namespace daumier::reports {

/// One table a split. `columns` are shown between the errors and the costs if a row has their key
/// (systems::System::summary_columns). @throws Error if a key is missing.
std::vector<ReportTable> AblationTables(const Json& table, const std::vector<Metric>& columns);

/// table.md: the tables, and how the intervals were made.
std::string AblationMarkdown(const Json& table, const std::vector<Metric>& columns);

/// How intervals and differences were made, in a few sentences.
std::string AblationFootnote();

}  // namespace daumier::reports
