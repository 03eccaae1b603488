#pragma once
#include "core/json.h"
#include "reports/report_table.h"

#include <span>
#include <string>
#include <vector>

namespace daumier::benchmark {

/// Rows of one task (KitScoresToJson), least error first, without their items:
///   {benchmark, kit_hash, task, split, measure, rows: [{method, num_items, num_missing, topology, predictions_hash, errors by
///   measure, groups, difference: {mean, low, high}}]}
/// The measure that orders them is the surface's error, which all topologies have, or the NME. `difference` is the mean of the errors
/// less those of the first row, item by item, with the 95 % interval of a bootstrap over persons: both read the same inputs.
/// @throws Error naming the row (by the name of its method) that is of another benchmark, kit, task or split than the first, lacks
/// an item, or is no row.
Json SummariseRows(std::span<const Json> rows);

/// Columns: method, training data, errors with intervals, median, 90th percentile, difference from the first, what is missing.
reports::ReportTable RowsTable(const Json& summary);

}  // namespace daumier::benchmark
