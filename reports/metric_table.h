#pragma once
#include "core/json.h"
#include "core/statistics.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::reports {

/// A column of a table of results: `key` in JSON; title, unit and digits for people.
struct Metric {
  std::string key, title, unit;
  int digits = 3;
};

/// A predictor measured on some faces: a value for each column of its table, absent where it was not measured.
struct MetricRow {
  std::string name;
  /// Where the curve coefficients of a sketch come from: "none", "given" or "recovered"; empty in other tables.
  std::string input = "";
  bool baseline = false;  ///< Needs no training.
  double error = 0;       ///< Mean over faces, mm.
  Interval interval{0, 0};
  std::vector<std::optional<double>> values = {};  ///< One a column.
  std::vector<double> face_errors = {};            ///< One a face of the table, mm; empty if it measures fewer of them.
};

struct MetricTable {
  std::vector<Metric> columns;
  std::vector<MetricRow> rows;
  std::vector<int> faces, groups;  ///< Indices of the measured faces, and whom each shows: what is resampled as one.
  Json data_hash;                  ///< Of every database that was read.
};

}  // namespace daumier::reports
