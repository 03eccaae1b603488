#pragma once
#include "core/json.h"
#include "eval/drawing_score.h"
#include "reports/report_table.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::eval {

/// Scores of the drawings of a group. Errors are in per cent of the distance of the outer corners of the eyes.
struct DrawingGroup {
  std::string name;
  int num_drawings = 0, num_predicted = 0;
  /// Mean over drawings of the mean error of their points (NME), and its median.
  double nme = 0, median_nme = 0;
  double mean_face_nme = 0;  ///< Of the mean face placed best.
  double aligned_nme = 0;    ///< Of the predictions placed best.
  int num_better = 0;        ///< Drawings of smaller error than the mean face placed best.
  /// Of each part, of the drawings that have one: prediction, and mean face placed best.
  std::array<std::optional<double>, kNumDrawnParts> parts = {}, mean_face_parts = {};
  /// States that are right, of those that labels have.
  int mouth_right = 0, mouth_known = 0, eyes_right = 0, eyes_known = 0;
  int num_crossed_lips = 0;
  int num_recognised = 0;
};

/// By name in the order of the first drawing.
std::vector<DrawingGroup> GroupScores(std::span<const DrawingScore> scores);

/// A row a drawing; the second: a row a group.
reports::ReportTable DrawingTable(std::span<const DrawingScore> scores);
reports::ReportTable DrawingGroupTable(std::span<const DrawingGroup> groups);

/// {unit, groups: [...], drawings: [...]}: the numbers of both tables by name, null where there is none.
Json DrawingScoresToJson(std::span<const DrawingScore> scores);

}  // namespace daumier::eval
