#pragma once
#include "reports/metric_table.h"

#include <vector>

namespace daumier::sketch {

/// Columns of the table of a parser's report: error (mean distance of the shown points over the eye distance), median
/// and p90 of drawings, and the same error of each of PointParts.
const std::vector<reports::Metric>& ParserColumns();
/// Columns of a table of several runs, besides the error.
std::vector<reports::Metric> ParserSummaryColumns();

}  // namespace daumier::sketch
