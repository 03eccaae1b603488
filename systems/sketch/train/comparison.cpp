#include "systems/sketch/train/comparison.h"

#include "core/error.h"
#include "reports/comparison_sheet.h"
#include "systems/sketch/train/measurement.h"
#include "geometry/coordinates.h"
#include "render/strokes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::sketch {
namespace {

/// The row of a face, without predictions.
reports::ComparedFace RowOf(const reports::ChosenFace& shown, const SketchMeasurement& measurement) {
  const auto seen = measurement.Seen(shown.face);
  return {.title = shown.title,
          .sketch = render::RasteriseStrokes(seen.strokes, render::kSketchCanvas, seen.style),
          .truth = measurement.data().faces.points(shown.face),
          .predictions = {}};
}

/// Mean over the vertices where an error is counted.
double MeanError(const Eigen::VectorXd& error_mm) {
  std::vector<double> counted;
  std::copy_if(error_mm.begin(), error_mm.end(), std::back_inserter(counted), [](double e) { return !std::isnan(e); });
  return eval::Mean(counted);
}

reports::ComparedPrediction PredictionOf(const reports::ChosenFace& shown, const SketchMeasurement& measurement) {
  const eval::FaceRows predicted = measurement.PredictResult(std::span(&shown.face, 1));
  const Eigen::VectorXd error_mm = measurement.ErrorMap(predicted, shown.face);
  return {geometry::PointsFrom(eval::RowSpan(predicted, 0)), error_mm, MeanError(error_mm)};
}

}  // namespace

render::Image SketchComparison(const std::vector<ComparedRun>& runs, const std::vector<reports::ChosenFace>& faces) {
  DAUMIER_CHECK(!runs.empty(), "a comparison needs a run");
  std::vector<std::string> names;
  std::vector<reports::ComparedFace> rows;
  faces::FaceTemplate face_template;
  Json data_hash;
  for (const ComparedRun& one : runs) {
    const SketchRunData data = OpenSketchRunData(one.run);
    const SketchMeasurement measurement(data, one.options);
    const Json& hash = data.run.manifest.details.at("data");
    if (names.empty()) {
      data_hash = hash;
      face_template = data.faces.face_template();
      for (const reports::ChosenFace& face : faces) rows.push_back(RowOf(face, measurement));
    }
    DAUMIER_CHECK(hash == data_hash, "{} was trained on other data than {}", one.run.string(), runs[0].run.string());
    names.push_back(one.name);
    for (size_t i = 0; i < rows.size(); ++i) rows[i].predictions.push_back(PredictionOf(faces[i], measurement));
  }
  return reports::ComparisonSheet(face_template, names, rows);
}

}  // namespace daumier::sketch
