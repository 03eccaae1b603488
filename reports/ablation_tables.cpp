#include "reports/ablation_tables.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::reports {
namespace {

/// The columns of the rows of one split. The first one is in each row of table.json.
std::vector<Metric> ColumnsOf(const Json& rows, const std::vector<Metric>& further) {
  const std::string unit = rows.front().at("unit").get<std::string>();
  const auto any = [&](const char* key) {
    return std::any_of(rows.begin(), rows.end(), [&](const Json& row) { return !row.value(key, Json()).is_null(); });
  };
  std::vector<Metric> columns = {{.key = "paper", .title = "paper " + unit, .digits = 2}};
  if (any("measured_on")) {
    columns.push_back({.key = "error", .title = "validation " + unit});
  } else {
    std::string difference = "difference";
    for (const Json& row : rows)
      if (const Json to = row.value("difference_to", Json()); to.is_string())
        difference = "against " + to.get<std::string>();
    columns.push_back({.key = "error", .title = unit, .interval = ShowInterval::kInColumn, .interval_digits = 2});
    columns.push_back({.key = "difference",
                       .title = difference,
                       .digits = 2,
                       .interval = ShowInterval::kInCell,
                       .interval_digits = 2,
                       .sign = true});
  }
  columns.insert(columns.end(), further.begin(), further.end());
  columns.push_back({.key = "validation_at_equal_time", .title = "validation at equal time", .may_hide = true});
  columns.push_back({.key = "steps", .title = "steps", .digits = 0});
  columns.push_back({.key = "parameters", .title = "parameters", .digits = 0});
  columns.push_back({.key = "train_seconds", .title = "training s", .digits = 0});
  columns.push_back({.key = "infer_ms", .title = "ms a face", .digits = 2, .may_hide = true});
  columns.push_back({.key = "num_seeds", .title = "seeds", .digits = 0});
  return columns;
}

}  // namespace

std::vector<ReportTable> AblationTables(const Json& table, const std::vector<Metric>& columns) {
  std::vector<ReportTable> tables;
  try {
    for (size_t begin = 0, end = 0; begin < table.size(); begin = end) {
      const Json& split = table[begin].at("split");
      Json rows = Json::array();
      for (; end < table.size() && table[end].at("split") == split; ++end) {
        rows.push_back(table[end]);
        rows.back()["num_seeds"] = rows.back().at("seeds").size();
      }
      MetricTable of_split{.columns = ColumnsOf(rows, columns)};
      of_split.rows = RowsFromJson(rows, of_split.columns);
      tables.push_back(TextTable(of_split, fmt::format("Split: {}", split.get<std::string>()), "row"));
    }
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the table of an ablation is malformed: {}", error.what()));
  }
  return tables;
}

std::string AblationMarkdown(const Json& table, const std::vector<Metric>& columns) {
  std::string text;
  for (const ReportTable& one : AblationTables(table, columns))
    text += fmt::format("## {}\n\n{}\n", one.title, TableMarkdown(one));
  return text + AblationFootnote() + "\n";
}

std::string AblationFootnote() {
  return "Errors are means over test faces and then over seeds. 95 % intervals come from a bootstrap over persons, "
         "each "
         "with all of its test faces of all seeds; seeds are not resampled, and table.json has the errors of each "
         "seed. "
         "The difference is to one row, and paired by faces. The paper's figures are of the paper's own data. "
         "Milliseconds are the median of single faces on the CPU. Validation errors are the least of each training.";
}

}  // namespace daumier::reports
