#pragma once
#include "reports/metric_table.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::ablation {

/// A row of a report's table, as an ablation compares it.
struct AblationMeasure {
  double error = 0;  ///< mm
  std::optional<Interval> interval = {};
  bool of_run = false;     ///< A row of the run's own network, which has the run's cost.
  bool is_result = false;  ///< The row of the report's result, whose predictions the report keeps.
  /// Further entries of table.json by key: shape_input, p90, num_faces, data_hash, ...
  Json more = Json::object();
  /// The error of each test face, mm, and the person it shows; empty if the row was measured on a subset of the faces.
  std::vector<double> face_errors = {};
  std::vector<int> groups = {};
};

/// @throws Error if the report is of an earlier version that has no errors of faces.
AblationMeasure MeasureOf(const reports::MetricTable& table, const reports::MetricRow& row);

/// Equal texts iff two reports were measured on the same faces. @throws Error if metrics.json is malformed.
std::string TestSetId(const Json& metrics);

}  // namespace daumier::ablation
