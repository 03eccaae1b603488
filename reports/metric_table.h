#pragma once
#include "core/json.h"
#include "core/statistics.h"
#include "reports/report_table.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// The one table of results: evaluations fill it, ablations join several, and JSON, Markdown and HTML are made of it.
namespace daumier::reports {

/// Where a table shows the interval of a value.
enum class ShowInterval {
  kNone,      ///< There is none.
  kInColumn,  ///< A column of its own: "2.10 to 2.31".
  kInCell,    ///< Behind the value: "2.20 (2.10 to 2.31)".
};

/// A column: `key` in JSON; title, unit and digits for people.
struct Metric {
  std::string key;
  std::string title;
  std::string unit = "";  ///< "mm", "model units", ...; "%" is repeated behind each number.
  int digits = 3;
  double scale = 1;  ///< The number shown is scale * value.
  ShowInterval interval = ShowInterval::kNone;
  int interval_digits = 3;
  bool sign = false;        ///< Whether a number > 0 has a plus sign.
  bool may_hide = false;    ///< The column is left out of a text if no row has a value.
  std::string of_key = "";  ///< The per-face numbers that it summarises, by the key of their column; empty: its own.
  std::optional<double> percentile = {};  ///< Of the per-face numbers; absent: their mean.
};

struct MetricValue {
  double mean = 0;
  std::optional<Interval> interval = {};  ///< 95 %, by PersonBootstrap.
};

/// A predictor measured on some faces.
struct MetricRow {
  std::string name;
  /// Where the curve coefficients of a sketch come from: "none", "given" or "recovered"; empty in other tables.
  std::string input = "";
  bool baseline = false;                                ///< Needs no training and does not depend on the run.
  std::vector<std::optional<MetricValue>> values = {};  ///< One a column; absent where it was not measured.
  /// First column for the first faces of the table, as many as this has; empty if unknown.
  std::vector<double> face_errors = {};
  Json details = Json::object();  ///< Further entries of the row in JSON.

  /// The value of the first column. @throws Error if it was not measured.
  const MetricValue& error() const;
};

struct MetricTable {
  std::vector<Metric> columns;  ///< The first is the error by which rows are compared.
  std::vector<MetricRow> rows = {};
  size_t result = 0;                         ///< The row of the run's own network.
  std::vector<int> faces = {}, groups = {};  ///< Indices of the measured faces; person of each, resampled as one.
  Json data_hash = {};                       ///< Of every database that was read.
};

/// Numbers of each face by the key of their column, in the order of MetricTable::faces. A list may be shorter: numbers
/// of the first faces. A key without a list was not measured.
using FaceValues = std::map<std::string, std::vector<double>>;

/// A row of `table`, whose columns and groups it reads: means or percentiles of the numbers of faces, and intervals by
/// PersonBootstrap with `seed`. @throws Error naming the row and the column if a number is not finite or there are more
/// numbers than groups.
MetricRow MakeRow(const MetricTable& table, const std::string& name, const FaceValues& values, uint64_t seed);

/// The row of that name, or of the result's name if it is empty. `input`: of that input; empty: the result, if it has
/// that name, otherwise the first. @throws Error if there is no such row.
const MetricRow& FindRow(const MetricTable& table, const std::string& name, const std::string& input = "");

/// The index of the column of that key, absent if there is none.
std::optional<size_t> FindColumn(const std::vector<Metric>& columns, const std::string& key);
/// The value of the row in the column of that key, absent if there is none.
std::optional<double> ValueOf(const MetricTable& table, const MetricRow& row, const std::string& key);

/// A list of objects: name, shape_input (if the row has an input), baseline, KEY of each column (null where it was not
/// measured; with an interval also KEY_low and KEY_high), the entries of `details`, and face_errors_mm, or face_errors
/// if the unit of the first column is not mm.
Json TableJson(const MetricTable& table);
/// Undoes TableJson; of the entries only those of `columns` are read, details are not. A missing entry is an absent
/// value, apart from the first column's. @throws Error if the list is malformed.
std::vector<MetricRow> RowsFromJson(const Json& list, const std::vector<Metric>& columns);

/// The table that the metrics of a report hold: the entries table, faces, groups and data_hash. Of earlier versions faces
/// and groups may be absent. @throws Error "the metrics of {run} are malformed: ...".
MetricTable TableFromMetrics(const Json& metrics, const std::vector<Metric>& columns, const std::string& run);

/// The table as text: the rows' names under `names`, the input if a row has one, then the columns. A dash marks an
/// absent value.
ReportTable TextTable(const MetricTable& table, const std::string& title = "Errors",
                      const std::string& names = "predictor");

}  // namespace daumier::reports
