#include "reports/comparison_sheet.h"

#include "core/error.h"
#include "render/camera.h"
#include "render/draw.h"
#include "render/heat_map.h"
#include "render/sheet.h"
#include "render/ticks.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"

#include <algorithm>

namespace daumier::reports {
namespace {

constexpr double kSheetMargin = 1.1;

double RangeOf(const std::vector<ComparedFace>& faces, double range_mm) {
  if (range_mm > 0) return range_mm;
  double sum = 0;
  for (const ComparedFace& face : faces)
    for (const ComparedPrediction& prediction : face.predictions) sum += prediction.mean_error_mm;
  const double mean = sum / double(faces.size() * faces.front().predictions.size());
  return mean > 0 ? render::NiceCeiling(2 * mean, 5) : 1.0;
}

void CheckFaces(const std::vector<std::string>& names, const std::vector<ComparedFace>& faces) {
  DAUMIER_CHECK(!faces.empty() && !names.empty(),
                "a comparison of {} predictors on {} faces, expected at least one of each", names.size(), faces.size());
  const Eigen::Index num_vertices = faces.front().truth.rows();
  for (const ComparedFace& face : faces) {
    DAUMIER_CHECK(face.predictions.size() == names.size(), "'{}' has {} predictions for {} predictors", face.title,
                  face.predictions.size(), names.size());
    DAUMIER_CHECK(face.sketch.height == face.sketch.width, "the sketch of '{}' is {} x {}, expected a square",
                  face.title, face.sketch.height, face.sketch.width);
    for (const ComparedPrediction& prediction : face.predictions)
      DAUMIER_CHECK(face.truth.rows() == num_vertices && prediction.face.rows() == num_vertices &&
                        prediction.error_mm.size() == num_vertices,
                    "'{}' has {} true vertices, {} predicted ones and {} errors, expected {} each", face.title,
                    face.truth.rows(), prediction.face.rows(), prediction.error_mm.size(), num_vertices);
  }
}

}  // namespace

render::Image ComparisonSheet(const ReportSurface& surface, const std::vector<std::string>& names,
                              const std::vector<ComparedFace>& faces, double range_mm) {
  CheckFaces(names, faces);
  const render::ValueRange range{0.0, RangeOf(faces, range_mm)};
  std::vector<geometry::Points> shown;
  for (const ComparedFace& face : faces) shown.push_back(face.truth);
  const render::Frame frame = FrameOfFaces(shown, kSheetMargin);
  geometry::Points mean = geometry::Points::Zero(faces.front().truth.rows(), 3);
  for (const ComparedFace& face : faces) mean += face.truth / double(faces.size());
  const faces::FinishedHead head = HeadOf(surface, mean);
  const bool has_sketch =
      std::any_of(faces.begin(), faces.end(), [](const ComparedFace& face) { return face.sketch.height > 0; });
  const auto camera = render::FrontalCamera(frame.centre, frame.half_height, kCell);
  const int columns = int(names.size()) + (has_sketch ? 3 : 2);
  render::SheetStyle style{.column_titles = {"truth"}, .gap = 6};
  if (has_sketch) style.column_titles.insert(style.column_titles.begin(), "sketch");
  style.column_titles.insert(style.column_titles.end(), names.begin(), names.end());
  std::vector<render::SheetCell> cells;
  for (const ComparedFace& face : faces) {
    style.row_titles.push_back(face.title);
    if (has_sketch)
      cells.push_back({face.sketch.height > 0 ? render::Resize(face.sketch, kCell, kCell) : render::Image()});
    cells.push_back({render::RenderMesh(InputOf(head, face.truth), camera)});
    for (const ComparedPrediction& prediction : face.predictions)
      cells.push_back(
          {render::RenderHeatMap(InputOf(head, prediction.face), head.Values(prediction.error_mm), range, camera),
           fmt::format("{:.2f} mm", prediction.mean_error_mm)});
    const bool first = &face == &faces.front();
    cells.push_back({first ? render::Image(kCell, render::kColourBarWidth, 3) : render::Image()});
    if (first) render::DrawColourBar(cells.back().image, range, "mm");
  }
  return render::MakeSheet(cells, columns, style);
}

}  // namespace daumier::reports
