#include "reports/metric_table.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace daumier::reports {
namespace {

constexpr const char* kInputKey = "shape_input";

MetricValue Summarise(const Metric& column, std::span<const double> numbers, std::span<const int> groups,
                      uint64_t seed) {
  DAUMIER_CHECK(numbers.size() <= groups.size(), "{} numbers of {} faces", numbers.size(), groups.size());
  MetricValue value{column.percentile ? Percentile(numbers, *column.percentile) : Mean(numbers)};
  if (column.interval != ShowInterval::kNone)
    value.interval = PersonBootstrap(numbers, groups.first(numbers.size()), seed);
  return value;
}

std::string Number(const Metric& column, double value, int digits) {
  const std::string number = column.sign ? fmt::format("{:+.{}f}", column.scale * value, digits)
                                         : fmt::format("{:.{}f}", column.scale * value, digits);
  return column.unit == "%" ? number + " %" : number;
}

std::string IntervalText(const Metric& column, const std::optional<Interval>& interval) {
  if (!interval) return "-";
  return fmt::format("{} to {}", Number(column, interval->low, column.interval_digits),
                     Number(column, interval->high, column.interval_digits));
}

void AppendCells(const Metric& column, const std::optional<MetricValue>& value, std::vector<std::string>& cells) {
  const std::string number = value ? Number(column, value->mean, column.digits) : "-";
  switch (column.interval) {
    case ShowInterval::kNone:
      cells.push_back(number);
      break;
    case ShowInterval::kInColumn:
      cells.push_back(number);
      cells.push_back(value ? IntervalText(column, value->interval) : "-");
      break;
    case ShowInterval::kInCell:
      cells.push_back(value ? fmt::format("{} ({})", number, IntervalText(column, value->interval)) : "-");
      break;
  }
}

/// Whether all faces of the row, the first of the table, are of one person: an interval by person says nothing then.
bool IsOfOnePerson(const MetricTable& table, const MetricRow& row) {
  const size_t num_faces =
      row.face_errors.empty() ? table.groups.size() : std::min(row.face_errors.size(), table.groups.size());
  const auto groups = std::span(table.groups).first(num_faces);
  return !groups.empty() && std::ranges::all_of(groups, [&](int group) { return group == groups.front(); });
}

const char* FaceErrorsKey(const std::vector<Metric>& columns) {
  return columns.front().unit == "mm" ? "face_errors_mm" : "face_errors";
}

/// A whole number of a column without digits is an integer in JSON.
Json NumberJson(const Metric& column, double value) {
  if (column.digits == 0 && value == std::floor(value)) return int64_t(value);
  return value;
}

void AppendValue(const Metric& column, const std::optional<MetricValue>& value, Json& entry) {
  entry[column.key] = value ? NumberJson(column, value->mean) : Json();
  if (column.interval == ShowInterval::kNone) return;
  const bool has_interval = value && value->interval;
  entry[column.key + "_low"] = has_interval ? Json(value->interval->low) : Json();
  entry[column.key + "_high"] = has_interval ? Json(value->interval->high) : Json();
}

std::optional<double> NumberFrom(const Json& entry, const std::string& key) {
  const auto found = entry.find(key);
  return found == entry.end() || found->is_null() ? std::nullopt : std::optional(found->get<double>());
}

std::optional<MetricValue> ValueFrom(const Json& entry, const Metric& column) {
  const std::optional<double> mean = NumberFrom(entry, column.key);
  if (!mean) return std::nullopt;
  MetricValue value{*mean};
  const std::optional<double> low = NumberFrom(entry, column.key + "_low"),
                              high = NumberFrom(entry, column.key + "_high");
  if (low && high) value.interval = Interval{*low, *high};
  return value;
}

}  // namespace

const MetricValue& MetricRow::error() const {
  DAUMIER_CHECK(!values.empty() && values.front(), "the error of '{}' was not measured", name);
  return *values.front();
}

MetricRow MakeRow(const MetricTable& table, const std::string& name, const FaceValues& values, uint64_t seed) {
  MetricRow row{.name = name};
  for (const Metric& column : table.columns) {
    const auto numbers = values.find(column.of_key.empty() ? column.key : column.of_key);
    std::optional<MetricValue>& value = row.values.emplace_back();
    if (numbers == values.end()) continue;
    try {
      value = Summarise(column, numbers->second, table.groups, seed);
    } catch (const Error& error) {
      throw Error(fmt::format("row '{}', '{}' of faces: {}", name, numbers->first, error.what()));
    }
  }
  if (const auto errors = values.find(table.columns.front().key); errors != values.end())
    row.face_errors = errors->second;
  return row;
}

const MetricRow& FindRow(const MetricTable& table, const std::string& name, const std::string& input) {
  DAUMIER_CHECK(table.result < table.rows.size(), "a table of {} rows has no row {}, its result", table.rows.size(),
                table.result);
  const MetricRow& result = table.rows[table.result];
  const std::string& wanted = name.empty() ? result.name : name;
  if (input.empty() && wanted == result.name) return result;
  const auto found = std::find_if(table.rows.begin(), table.rows.end(), [&](const MetricRow& row) {
    return row.name == wanted && (input.empty() || row.input == input);
  });
  if (found != table.rows.end()) return *found;
  std::vector<std::string> names;
  for (const MetricRow& row : table.rows)
    names.push_back(row.input.empty() ? row.name : fmt::format("{} ({})", row.name, row.input));
  throw Error(fmt::format("the table has no row '{}'{}; rows are: {}", wanted,
                          input.empty() ? "" : fmt::format(" of input '{}'", input), fmt::join(names, ", ")));
}

std::optional<size_t> FindColumn(const std::vector<Metric>& columns, const std::string& key) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Metric& one) { return one.key == key; });
  return found == columns.end() ? std::nullopt : std::optional(size_t(found - columns.begin()));
}

std::optional<double> ValueOf(const MetricTable& table, const MetricRow& row, const std::string& key) {
  const std::optional<size_t> column = FindColumn(table.columns, key);
  if (!column || !row.values[*column]) return std::nullopt;
  return row.values[*column]->mean;
}

Json TableJson(const MetricTable& table) {
  Json list = Json::array();
  for (const MetricRow& row : table.rows) {
    DAUMIER_CHECK(row.values.size() == table.columns.size(), "row '{}' has {} values of {} columns", row.name,
                  row.values.size(), table.columns.size());
    Json entry = {{"name", row.name}};
    if (!row.input.empty()) entry[kInputKey] = row.input;
    entry["baseline"] = row.baseline;
    for (size_t i = 0; i < table.columns.size(); ++i) AppendValue(table.columns[i], row.values[i], entry);
    for (const auto& [key, value] : row.details.items()) entry[key] = value;
    if (!row.face_errors.empty()) entry[FaceErrorsKey(table.columns)] = row.face_errors;
    list.push_back(std::move(entry));
  }
  return list;
}

std::vector<MetricRow> RowsFromJson(const Json& list, const std::vector<Metric>& columns) {
  std::vector<MetricRow> rows;
  try {
    for (const Json& entry : list) {
      MetricRow row{.name = entry.at("name").get<std::string>(), .baseline = entry.value("baseline", false)};
      if (const Json input = entry.value(kInputKey, Json()); input.is_string()) row.input = input.get<std::string>();
      entry.at(columns.front().key);
      for (const Metric& column : columns) row.values.push_back(ValueFrom(entry, column));
      row.face_errors = entry.value(FaceErrorsKey(columns), std::vector<double>());
      rows.push_back(std::move(row));
    }
  } catch (const Json::exception& error) {
    throw Error(fmt::format("a table of results is malformed: {}", TextOf(error)));
  }
  return rows;
}

MetricTable TableFromMetrics(const Json& metrics, const std::vector<Metric>& columns, const std::string& run) {
  try {
    MetricTable table{.columns = columns, .rows = RowsFromJson(metrics.at("table"), columns)};
    table.faces = metrics.value("faces", std::vector<int>());
    table.groups = metrics.value("groups", std::vector<int>());
    table.data_hash = metrics.at("data_hash");
    return table;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of {} are malformed: {}", run, TextOf(error)));
  }
}

ReportTable TextTable(const MetricTable& table, const std::string& title, const std::string& names) {
  const auto any = [&](const auto& has) { return std::any_of(table.rows.begin(), table.rows.end(), has); };
  ReportTable text{title, {names}, {}};
  const bool has_input = any([](const MetricRow& row) { return !row.input.empty(); });
  if (has_input) text.header.push_back("shape input");
  std::vector<size_t> shown;
  for (size_t i = 0; i < table.columns.size(); ++i) {
    const Metric& column = table.columns[i];
    if (column.may_hide && !any([&](const MetricRow& row) { return row.values[i].has_value(); })) continue;
    shown.push_back(i);
    text.header.push_back(column.title);
    if (column.interval == ShowInterval::kInColumn) text.header.push_back("95 % interval");
  }
  for (const MetricRow& row : table.rows) {
    std::vector<std::string>& cells = text.rows.emplace_back(1, row.name);
    if (has_input) cells.push_back(row.input.empty() ? "-" : row.input);
    const bool has_spread = !IsOfOnePerson(table, row);
    for (const size_t i : shown) {
      std::optional<MetricValue> value = row.values[i];
      if (value && !has_spread) value->interval.reset();
      AppendCells(table.columns[i], value, cells);
    }
  }
  return text;
}

}  // namespace daumier::reports
