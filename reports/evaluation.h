#pragma once
#include "core/manifest.h"
#include "reports/metric_table.h"
#include "reports/report.h"

namespace daumier::reports {

/// What `daumier eval` finds out of a run, in memory.
struct Evaluation {
  MetricTable table;
  size_t result = 0;  ///< The row of the run's own network.
  Json metrics;       ///< metrics.json.
  ReportData report;
  Manifest manifest;
  /// The result's faces that a sheet shows (ChooseFaces), for pictures without another prediction.
};

}  // namespace daumier::reports
