#include "systems/deform/train/table.h"

#include "core/error.h"

#include <fmt/ranges.h>

namespace daumier::deform {
namespace {

/// Mean of what was measured of some faces; nothing if it was of none.
std::optional<double> MeanOfTold(const std::vector<SurfaceErrors>& errors, std::optional<double> SurfaceErrors::*what) {
  std::vector<double> told;
  for (const SurfaceErrors& one : errors)
    if (one.*what) told.push_back(*(one.*what));
  return told.empty() ? std::nullopt : std::optional<double>(eval::Mean(told));
}

double PercentOfHead(double error, const ModelUnit& unit) {
  return 100 * error / unit.head_height;
}

Json OrNull(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

}  // namespace

ModelUnit UnitOf(const faces::FaceTemplate& face_template, const faces::ModelFrame& frame) {
  const auto heights = face_template.neutral.col(1);
  const double chin = heights[face_template.annotation.landmarks[8]];
  return {faces::MillimetresPerCm(face_template) / frame.scale, frame.scale * (heights.maxCoeff() - chin)};
}

DeformRow MakeDeformRow(const std::string& name, const std::vector<SurfaceErrors>& errors, std::span<const int> groups,
                        uint64_t seed) {
  const auto column = [&](double SurfaceErrors::*what) {
    std::vector<double> values;
    for (const SurfaceErrors& one : errors) values.push_back(one.*what);
    return values;
  };
  DeformRow row{name, int(errors.size()), {}, {0, 0}};
  const std::vector<double> vertex_errors = column(&SurfaceErrors::mean_vertex_error);
  row.interval = eval::PersonBootstrap(vertex_errors, groups, seed);
  row.mean.mean_vertex_error = eval::Mean(vertex_errors);
  row.face_errors = vertex_errors;
  for (const auto what : {&SurfaceErrors::p95_vertex_error, &SurfaceErrors::surface_sample_error,
                          &SurfaceErrors::normal_error_degrees, &SurfaceErrors::flipped_triangles})
    row.mean.*what = eval::Mean(column(what));
  for (const auto what : {&SurfaceErrors::self_intersections, &SurfaceErrors::seconds})
    row.mean.*what = MeanOfTold(errors, what);
  return row;
}

Json DeformTableJson(const std::vector<DeformRow>& rows, const ModelUnit& unit) {
  Json table = Json::array();
  for (const DeformRow& row : rows) {
    const SurfaceErrors& mean = row.mean;
    table.push_back({{"name", row.name},
                     {"num_faces", row.num_faces},
                     {"error", mean.mean_vertex_error},
                     {"error_low", row.interval.low},
                     {"error_high", row.interval.high},
                     {"p95", mean.p95_vertex_error},
                     {"surface_sample_error", mean.surface_sample_error},
                     {"error_mm", mean.mean_vertex_error * unit.mm},
                     {"percent_of_head_height", PercentOfHead(mean.mean_vertex_error, unit)},
                     {"normal_error_degrees", mean.normal_error_degrees},
                     {"flipped_triangles", mean.flipped_triangles},
                     {"self_intersections", OrNull(mean.self_intersections)},
                     {"seconds", OrNull(mean.seconds)},
                     {"face_errors", row.face_errors}});
  }
  return table;
}

reports::ReportTable DeformReportTable(const std::vector<DeformRow>& rows, const ModelUnit& unit) {
  reports::ReportTable table{"Errors",
                    {"predictor", "faces", "model units", "95 % interval", "95th percentile", "surface samples", "mm",
                     "of head height", "normals, degrees", "flipped", "self-intersections", "seconds a face"},
                    {}};
  for (const DeformRow& row : rows) {
    const SurfaceErrors& mean = row.mean;
    const auto told = [](const std::optional<double>& number, int digits) {
      return number ? fmt::format("{:.{}f}", *number, digits) : std::string("-");
    };
    table.rows.push_back(
        {row.name, fmt::format("{}", row.num_faces), fmt::format("{:.4f}", mean.mean_vertex_error),
         fmt::format("{:.4f} to {:.4f}", row.interval.low, row.interval.high),
         fmt::format("{:.4f}", mean.p95_vertex_error), fmt::format("{:.4f}", mean.surface_sample_error),
         fmt::format("{:.3f}", mean.mean_vertex_error * unit.mm),
         fmt::format("{:.2f} %", PercentOfHead(mean.mean_vertex_error, unit)),
         fmt::format("{:.2f}", mean.normal_error_degrees), fmt::format("{:.1f}", mean.flipped_triangles),
         told(mean.self_intersections, 1), told(mean.seconds, 2)});
  }
  return table;
}

std::string DeformTableMarkdown(const std::vector<DeformRow>& rows, const ModelUnit& unit) {
  const reports::ReportTable table = DeformReportTable(rows, unit);
  std::string text = fmt::format("| {} |\n|---|", fmt::join(table.header, " | "));
  for (size_t column = 1; column < table.header.size(); ++column) text += "---:|";
  text += "\n";
  for (const auto& line : table.rows) text += fmt::format("| {} |\n", fmt::join(line, " | "));
  return text;
}

}  // namespace daumier::deform
