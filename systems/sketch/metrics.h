#pragma once
#include "reports/metric_table.h"

#include <vector>

namespace daumier::sketch {

/// Names of rows that need no training and do not depend on the run's network.
inline constexpr const char* kMeanFace = "mean face";
inline constexpr const char* kNearestNeighbour = "nearest neighbour";
inline constexpr const char* kRidge = "ridge regression";
inline constexpr const char* kModelLimit = "limit of the model";

/// Columns of the table of a report: error in mm over the region `face`, its percentiles over faces, and its share of
/// the distance of the outer eye corners.
const std::vector<reports::Metric>& SketchColumns();
/// Columns of a table of several runs, besides the error.
std::vector<reports::Metric> SketchSummaryColumns();

/// metrics.json of a report on a subset of a run's split as a table. In reports without flags the baselines are found
/// by the names above. The result's `details` hold regions_mm. @throws Error if it is malformed.
reports::MetricTable ReadSketchMetrics(const Json& metrics);

}  // namespace daumier::sketch
