#pragma once
#include "reports/metric_table.h"

#include <vector>

namespace daumier::sketch {

/// Columns of the table of a report on gestures, shares of strokes: error (likeliest gesture wrong), missed (gestures
/// that are rejected), none_accepted (other strokes that are accepted).
const std::vector<reports::Metric>& GestureColumns();
/// Columns of a table of several runs, besides the error.
std::vector<reports::Metric> GestureSummaryColumns();

}  // namespace daumier::sketch
