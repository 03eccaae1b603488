#pragma once
#include "reports/chosen_faces.h"
#include "reports/metric_table.h"
#include "reports/report.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace daumier::reports {

/// A predicted face with all that a picture of it needs.
struct FacePrediction {
  int face = 0;                        ///< Its index in the database.
  render::Image sketch;                ///< Square, grey or RGB; empty if the input is no picture.
  geometry::Points truth, prediction;  ///< V x 3, cm.
  Eigen::VectorXd error_mm;            ///< V; NaN where no error is counted.

  /// Mean over the vertices where an error is counted, mm. @throws Error if there is none.
  double mean_error_mm() const;
};

/// Predictions of some faces by one predictor: predictions.safetensors of a report. Sheets are drawn from them, without
/// the run and its databases.
struct Predictions {
  ReportSurface surface;
  std::vector<FacePrediction> faces;  ///< By ascending index.

  /// @throws Error if there is no prediction of the face.
  const FacePrediction& at(int face) const;
};

/// The faces whose predictions a report keeps, ascending: at most 16 evenly spaced faces of the table, equal
/// for all reports on these faces, and those of ChooseFaces by the errors of the result.
std::vector<int> KeptFaces(const MetricTable& table);

/// The faces of ChooseFaces by the errors of the result, titled "median: 2.31 mm; " + describe(face).
/// @throws Error if `predictions` lacks one.
std::vector<ReportSample> ChosenSamples(const MetricTable& table, const Predictions& predictions,
                                        const std::function<std::string(int face)>& describe);

/// safetensors: faces (n) int32, truth and vertices (n, V, 3) float32 in cm, error_mm (n, V) float32, sketches
/// (n, R, R, C) uint8 if all faces have one, triangles and closing_triangles (F, 3) int32; metadata
/// num_eye_closing_triangles. Returns the SHA-256. @throws Error if there is no face or shapes disagree.
std::string WritePredictions(const std::filesystem::path& file, const Predictions& predictions);
/// Undoes WritePredictions, up to float32. @throws Error naming file and cause.
Predictions ReadPredictions(const std::filesystem::path& file);

}  // namespace daumier::reports
