#pragma once
#include "core/json.h"
#include "faces/drawing_terms.h"
#include "reports/curve_chart.h"
#include "reports/report.h"
#include "systems/sketch/drawing_fitter.h"
#include "systems/sketch/train/test_set.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace daumier::sketch {

/// Numbers of strokes at which every drawing is measured.
inline constexpr int kPrefixes[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32};
/// Every fifth drawing is measured after each of its strokes.
inline constexpr int kEveryStrokeOf = 5;

/// Errors of the faces that the first strokes of a drawing give: mean distance over the region `face`, mm.
struct PrefixErrors {
  int face = 0, person = 0;
  std::vector<int> num_strokes;  ///< Ascending; the last is the whole drawing.
  std::vector<double> fitted_mm, network_mm;
  std::vector<bool> refused;                      ///< No face, which counts as the mean face.
  std::vector<faces::LineLabel> last_label = {};  ///< What the last of these strokes shows.
  double mean_face_mm = 0;

  /// Position of the longest prefix of at most this number of strokes: beyond its last stroke a drawing stays as it is.
  size_t at(int strokes) const;
  /// Whether each number of strokes was measured.
  bool has_every_stroke() const;
};

/// Faces evenly spaced in the test set, each drawn frontally and whole in a style that agrees with it
/// (datasets::StyledShare::DrawnAsTheFaceIs, no doodle). The first strokes, as the hand draws them, pass the whole chain:
/// parser, frame, network, fit. A face is measured upright, where nothing is aligned. The mean face is that of training
/// faces. parser: name of a run or of weights. @throws Error as OpenParserOfRun and DrawingFitter, Cancelled.
std::vector<PrefixErrors> MeasurePrefixes(const SketchTestSet& test, int num_faces, const std::string& parser,
                                          const DrawingFitOptions& fitting = {});

/// What is reported of them.
struct PrefixReport {
  /// {num_faces, num_persons, mean_face_mm, by_number: [{strokes, mm, interval_mm, network_mm, worse_than_mean_face,
  /// refused}], added_stroke: {num_faces, num, mean_mm, p95_mm, p99_mm, max_mm, above_1_mm}, of_faces: [{face,
  /// num_strokes, mm, network_mm, last_label, mean_face_mm}]}. strokes: a number, or
  /// "all"; worse_than_mean_face, refused and above_1_mm are shares. The cost of an added stroke is the error with it
  /// minus the error without, of drawings of which each prefix was measured.
  Json metrics;
  reports::ReportTable table;
  reports::ReportChart chart;
  std::vector<reports::ReportFact> facts;
};
/// Intervals by person (PersonBootstrap). @throws Error if there is no face.
PrefixReport ReportPrefixes(std::span<const PrefixErrors> faces, uint64_t seed);

}  // namespace daumier::sketch
