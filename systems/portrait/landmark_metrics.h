#pragma once
#include "reports/metric_table.h"

#include <vector>

namespace daumier::portrait {

/// Columns of the table of a report: error (mean error of 68 landmarks over the distance of the outer eye corners), p50 and
/// p90 of portraits, the same error of jaw, brows, nose, eyes and mouth, and found (share of portraits).
const std::vector<reports::Metric>& LandmarkColumns();
/// Columns of a table of several runs, besides the error.
std::vector<reports::Metric> LandmarkSummaryColumns();

}  // namespace daumier::portrait
