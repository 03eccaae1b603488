#include "systems/deform/metrics.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::deform {
namespace {

using reports::ShowInterval;

/// A column of a table in mm: `from` of DeformColumns, converted if it is in model units.
struct Converted {
  reports::Metric metric;
  const char* from;
  bool in_mm = false;
};

const std::vector<Converted>& ConvertedColumns() {
  static const std::vector<Converted> columns = {
      {{.key = "error", .title = "mm", .unit = "mm", .interval = ShowInterval::kInColumn}, "error", true},
      {{.key = "model_units", .title = "model units", .digits = 4}, "error"},
      {{.key = "percent_of_head_height", .title = "% of head", .digits = 2}, "percent_of_head_height"},
      {{.key = "p95", .title = "p95 of vertices", .digits = 2}, "p95", true},
      {{.key = "surface_sample_error_mm", .title = "surface samples"}, "surface_sample_error", true},
      {{.key = "normal_error_degrees", .title = "normals, degrees", .digits = 2}, "normal_error_degrees"},
      {{.key = "flipped_triangles", .title = "flips", .digits = 1}, "flipped_triangles"},
      {{.key = "self_intersections", .title = "self-intersections", .digits = 1}, "self_intersections"},
      {{.key = "seconds_a_face", .title = "seconds a face", .digits = 2}, "seconds"}};
  return columns;
}

std::optional<reports::MetricValue> Scaled(std::optional<reports::MetricValue> value, double factor) {
  if (!value) return value;
  value->mean *= factor;
  if (value->interval) value->interval = Interval{factor * value->interval->low, factor * value->interval->high};
  return value;
}

/// Reports of earlier versions have it only as the ratio of two errors; if all errors are 0, any will do.
double MmPerUnit(const Json& metrics, const reports::MetricTable& in_units) {
  if (metrics.contains("mm_per_unit")) return metrics.at("mm_per_unit").get<double>();
  for (const reports::MetricRow& row : in_units.rows)
    if (const auto mm = reports::ValueOf(in_units, row, "error_mm"); mm && row.error().mean > 0)
      return *mm / row.error().mean;
  return 1;
}

reports::MetricRow InMm(const reports::MetricTable& in_units, const reports::MetricRow& row, double mm) {
  reports::MetricRow converted{.name = row.name, .baseline = row.baseline};
  for (const Converted& column : ConvertedColumns())
    converted.values.push_back(
        Scaled(row.values.at(*reports::FindColumn(in_units.columns, column.from)), column.in_mm ? mm : 1));
  for (const double error : row.face_errors) converted.face_errors.push_back(mm * error);
  return converted;
}

/// Reports of earlier versions have no flags.
void FlagBaselines(reports::MetricTable& table) {
  const auto flagged = [](const reports::MetricRow& row) { return row.baseline; };
  if (std::any_of(table.rows.begin(), table.rows.end(), flagged)) return;
  for (reports::MetricRow& row : table.rows)
    row.baseline =
        row.name == kTemplate || row.name == kMeanFace || row.name == kNearestFace || row.name == kLinearModel;
}

}  // namespace

ModelUnit UnitOf(const faces::FaceTemplate& face_template, const faces::ModelFrame& frame) {
  const auto heights = face_template.neutral.col(1);
  const double chin = heights[face_template.annotation.landmarks[8]];
  return {faces::MillimetresPerCm(face_template) / frame.scale, frame.scale * (heights.maxCoeff() - chin)};
}

const std::vector<reports::Metric>& DeformColumns() {
  static const std::vector<reports::Metric> columns = {
      {.key = "error",
       .title = "model units",
       .unit = "model units",
       .digits = 4,
       .interval = ShowInterval::kInColumn,
       .interval_digits = 4},
      {.key = "num_faces", .title = "faces", .digits = 0},
      {.key = "p95", .title = "p95 of vertices", .unit = "model units", .digits = 4},
      {.key = "surface_sample_error", .title = "surface samples", .unit = "model units", .digits = 4},
      {.key = "error_mm", .title = "mm", .unit = "mm"},
      {.key = "percent_of_head_height", .title = "of head height", .unit = "%", .digits = 2},
      {.key = "normal_error_degrees", .title = "normals, degrees", .digits = 2},
      {.key = "flipped_triangles", .title = "flips", .digits = 1},
      {.key = "self_intersections", .title = "self-intersections", .digits = 1},
      {.key = "seconds", .title = "seconds a face", .digits = 2}};
  return columns;
}

std::vector<reports::Metric> DeformSummaryColumns() {
  std::vector<reports::Metric> columns;
  for (const char* key : {"p95", "surface_sample_error_mm", "percent_of_head_height", "normal_error_degrees",
                          "flipped_triangles", "self_intersections"})
    for (const Converted& column : ConvertedColumns())
      if (column.metric.key == key) {
        columns.push_back(column.metric);
        columns.back().may_hide = true;
      }
  return columns;
}

reports::MetricTable ReadDeformMetrics(const Json& metrics) {
  try {
    const reports::MetricTable in_units =
        reports::TableFromMetrics(metrics, DeformColumns(), "a deformable model's run");
    const double mm = MmPerUnit(metrics, in_units);
    reports::MetricTable table = in_units;
    table.columns.clear();
    table.rows.clear();
    for (const Converted& column : ConvertedColumns()) table.columns.push_back(column.metric);
    for (const reports::MetricRow& row : in_units.rows) table.rows.push_back(InMm(in_units, row, mm));
    FlagBaselines(table);
    return table;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of a deformable model's run are malformed: {}", TextOf(error)));
  }
}

}  // namespace daumier::deform
