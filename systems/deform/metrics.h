#pragma once
#include "faces/face_model.h"
#include "faces/model_frame.h"
#include "reports/metric_table.h"

#include <vector>

namespace daumier::deform {

/// What a unit of a model's frame means.
struct ModelUnit {
  double mm = 1;           ///< As faces::MillimetresPerCm counts them.
  double head_height = 1;  ///< Of the template's neutral head, chin to top along y, model units.
};
ModelUnit UnitOf(const faces::FaceTemplate& face_template, const faces::ModelFrame& frame);

/// Names of rows that need no training by steps.
inline constexpr const char* kTemplate = "template";
inline constexpr const char* kMeanFace = "mean face";
inline constexpr const char* kNearestFace = "nearest training face";
inline constexpr const char* kLinearModel = "linear model";

/// Columns of the table of a report, errors in model units: error (mean vertex error), num_faces, p95 (of vertices),
/// surface_sample_error, error_mm, percent_of_head_height, normal_error_degrees, flipped_triangles, self_intersections
/// and seconds (to find a code).
const std::vector<reports::Metric>& DeformColumns();
/// Columns of a table of several runs, besides the error, in mm.
std::vector<reports::Metric> DeformSummaryColumns();

/// metrics.json of a report as a table in mm: columns error, model_units, percent_of_head_height, p95,
/// surface_sample_error_mm, normal_error_degrees, flipped_triangles, self_intersections and seconds_a_face. In reports
/// without flags the baselines are found by the names above. @throws Error if it is malformed.
reports::MetricTable ReadDeformMetrics(const Json& metrics);

}  // namespace daumier::deform
