#pragma once
#include "core/json.h"
#include "reports/html_page.h"
#include "eval/metrics.h"
#include "faces/face_model.h"
#include "faces/model_frame.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::deform {

/// What a unit of a model's frame means.
struct ModelUnit {
  double mm = 1;           ///< As faces::MillimetresPerCm counts them.
  double head_height = 1;  ///< Of the template's neutral head, chin to top along y, model units.
};
ModelUnit UnitOf(const faces::FaceTemplate& face_template, const faces::ModelFrame& frame);

/// What a predictor made of one face.
struct SurfaceErrors {
  double mean_vertex_error = 0;     ///< Over all vertices, model units.
  double p95_vertex_error = 0;      ///< Over all vertices.
  double surface_sample_error = 0;  ///< eval::Mean over points that are uniform by area on the true surface.
  double normal_error_degrees = 0;
  double flipped_triangles = 0;
  std::optional<double> self_intersections;  ///< Pairs of triangles; where they were counted.
  std::optional<double> seconds;             ///< To find its code; where there is one.
};

/// A predictor on some faces: means of SurfaceErrors, and the interval of the mean vertex error.
struct DeformRow {
  std::string name;
  int num_faces = 0;
  SurfaceErrors mean;
  eval::Interval interval{0, 0};               ///< 95 %, by eval::PersonBootstrap.
  std::vector<double> face_errors = {};  ///< eval::Mean vertex errors, model units.
};

/// groups: whom each face shows. What was told of some faces alone is the mean of these. @throws Error if there is no
/// face or the lengths differ.
DeformRow MakeDeformRow(const std::string& name, const std::vector<SurfaceErrors>& errors, std::span<const int> groups,
                        uint64_t seed);

/// A list of objects: name, num_faces, error, error_low, error_high, p95, surface_sample_error (model units), error_mm,
/// percent_of_head_height, normal_error_degrees, flipped_triangles, self_intersections and seconds (null where they
/// were not measured), face_errors (model units).
Json DeformTableJson(const std::vector<DeformRow>& rows, const ModelUnit& unit);
/// The same for a page.
reports::ReportTable DeformReportTable(const std::vector<DeformRow>& rows, const ModelUnit& unit);
/// The same as a Markdown table.
std::string DeformTableMarkdown(const std::vector<DeformRow>& rows, const ModelUnit& unit);

}  // namespace daumier::deform
