#pragma once
#include "reports/predictions.h"
#include "systems/sketch/train/test_set.h"

#include <optional>

namespace daumier::sketch {

/// The rows of a sketch run's table, and what pictures need of its result.
struct SketchMeasurement {
  reports::MetricTable table;
  std::vector<double> of_vertices;       ///< Of the result: one error a vertex, mean over faces, mm.
  Json shape_error_px = Json::object();  ///< By input: mean distance of points rebuilt from curve coefficients.
  std::optional<double> ridge_lambda = {};
  reports::Predictions predictions;  ///< Of the result, of reports::KeptFaces.
};

/// Measures the rows that the options select, see EvaluateSketchRun. The network reads each sketch once for the result,
/// whose coefficients the rows "refined" and "deformed" and the pictures reuse.
/// @throws Error as EvaluateSketchRun, Cancelled.
SketchMeasurement MeasureSketchRun(const SketchTestSet& test, const SketchEvalOptions& options);

}  // namespace daumier::sketch
