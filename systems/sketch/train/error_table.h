#pragma once
#include "core/json.h"
#include "eval/metrics.h"

#include <string>
#include <vector>

namespace daumier::sketch {

/// One predictor measured on one split: mean over faces with its 95 % interval, and percentiles over faces, in
/// millimetres.
struct ErrorRow {
  std::string name;
  /// Whence it has the shape-level numbers of a sketch: "none", "given" (from labelled strokes) or "recovered".
  std::string shape_input = "none";
  double error_mm = 0;
  eval::Interval interval_mm{0, 0};
  double p50_mm = 0, p90_mm = 0, p99_mm = 0;
  double interocular_share = 0;  ///< eval::Mean over faces of error / distance of the outer eye corners of the true face.
  std::vector<double> face_errors_mm = {};
};

/// errors_mm and interocular_mm: one a face, in millimetres; persons: one a face. @throws Error if the lengths differ.
ErrorRow MakeErrorRow(const std::string& name, std::span<const double> errors_mm,
                      std::span<const double> interocular_mm, std::span<const int> persons, uint64_t seed);

/// The table as texts, three decimals: the head line, then a line a row; the first column holds the names.
std::vector<std::vector<std::string>> TableCells(const std::vector<ErrorRow>& rows);
/// Aligned text for a terminal / a Markdown table, both with a head line.
std::string TableText(const std::vector<ErrorRow>& rows);
std::string TableMarkdown(const std::vector<ErrorRow>& rows);

/// A list of objects: name, shape_input, error, error_low, error_high, p50, p90, p99 (mm), interocular_share,
/// face_errors_mm.
Json TableJson(const std::vector<ErrorRow>& rows);
/// Undoes TableJson; errors of faces may be missing. @throws Error if another key is.
std::vector<ErrorRow> TableFromJson(const Json& list);

}  // namespace daumier::sketch
