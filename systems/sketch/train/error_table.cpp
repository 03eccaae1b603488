#include "systems/sketch/train/error_table.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace daumier::sketch {

ErrorRow MakeErrorRow(const std::string& name, std::span<const double> errors_mm,
                      std::span<const double> interocular_mm, std::span<const int> persons, uint64_t seed) {
  DAUMIER_CHECK(errors_mm.size() == interocular_mm.size(), "{} errors but {} eye distances", errors_mm.size(),
                interocular_mm.size());
  ErrorRow row;
  row.name = name;
  row.error_mm = eval::Mean(errors_mm);
  row.interval_mm = eval::PersonBootstrap(errors_mm, persons, seed);
  row.p50_mm = eval::Percentile(errors_mm, 50);
  row.p90_mm = eval::Percentile(errors_mm, 90);
  row.p99_mm = eval::Percentile(errors_mm, 99);
  std::vector<double> shares(errors_mm.size());
  for (size_t face = 0; face < shares.size(); ++face) shares[face] = errors_mm[face] / interocular_mm[face];
  row.interocular_share = eval::Mean(shares);
  row.face_errors_mm.assign(errors_mm.begin(), errors_mm.end());
  return row;
}

std::vector<std::vector<std::string>> TableCells(const std::vector<ErrorRow>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"predictor", "shape input", "mm", "95 % interval", "median", "p90", "p99", "of eye distance"}};
  for (const ErrorRow& row : rows) {
    cells.push_back({row.name, row.shape_input, fmt::format("{:.3f}", row.error_mm),
                     fmt::format("{:.3f} to {:.3f}", row.interval_mm.low, row.interval_mm.high),
                     fmt::format("{:.3f}", row.p50_mm), fmt::format("{:.3f}", row.p90_mm),
                     fmt::format("{:.3f}", row.p99_mm), fmt::format("{:.2f} %", 100 * row.interocular_share)});
  }
  return cells;
}

std::string TableText(const std::vector<ErrorRow>& rows) {
  const std::vector<std::vector<std::string>> cells = TableCells(rows);
  std::vector<size_t> widths(cells.front().size(), 0);
  for (const auto& line : cells)
    for (size_t column = 0; column < line.size(); ++column)
      widths[column] = std::max(widths[column], line[column].size());
  std::string text;
  for (const auto& line : cells) {
    text += fmt::format("{:<{}}", line[0], widths[0]);
    for (size_t column = 1; column < line.size(); ++column)
      text += fmt::format("  {:>{}}", line[column], widths[column]);
    text += "\n";
  }
  return text;
}

std::string TableMarkdown(const std::vector<ErrorRow>& rows) {
  const std::vector<std::vector<std::string>> cells = TableCells(rows);
  std::string text;
  for (size_t line = 0; line < cells.size(); ++line) {
    text += fmt::format("| {} |\n", fmt::join(cells[line], " | "));
    if (line == 0) {
      text += "|---|";
      for (size_t column = 1; column < cells[0].size(); ++column) text += "---:|";
      text += "\n";
    }
  }
  return text;
}

Json TableJson(const std::vector<ErrorRow>& rows) {
  Json list = Json::array();
  for (const ErrorRow& row : rows) {
    list.push_back({{"name", row.name},
                    {"shape_input", row.shape_input},
                    {"error", row.error_mm},
                    {"error_low", row.interval_mm.low},
                    {"error_high", row.interval_mm.high},
                    {"p50", row.p50_mm},
                    {"p90", row.p90_mm},
                    {"p99", row.p99_mm},
                    {"interocular_share", row.interocular_share},
                    {"face_errors_mm", row.face_errors_mm}});
  }
  return list;
}

std::vector<ErrorRow> TableFromJson(const Json& list) {
  std::vector<ErrorRow> rows;
  try {
    for (const Json& entry : list) {
      rows.push_back({.name = entry.at("name").get<std::string>(),
                      .shape_input = entry.at("shape_input").get<std::string>(),
                      .error_mm = entry.at("error").get<double>(),
                      .interval_mm = {entry.at("error_low").get<double>(), entry.at("error_high").get<double>()},
                      .p50_mm = entry.at("p50").get<double>(),
                      .p90_mm = entry.at("p90").get<double>(),
                      .p99_mm = entry.at("p99").get<double>(),
                      .interocular_share = entry.at("interocular_share").get<double>(),
                      .face_errors_mm = entry.value("face_errors_mm", std::vector<double>())});
    }
  } catch (const Json::exception& error) {
    throw Error(fmt::format("a table of errors is malformed: {}", error.what()));
  }
  return rows;
}

}  // namespace daumier::sketch
