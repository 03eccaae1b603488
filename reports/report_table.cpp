#include "reports/report_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace daumier::reports {

std::string TableMarkdown(const ReportTable& table) {
  std::string text = fmt::format("| {} |\n|---|", fmt::join(table.header, " | "));
  for (size_t column = 1; column < table.header.size(); ++column) text += "---:|";
  text += "\n";
  for (const auto& row : table.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text;
}

std::string TableText(const ReportTable& table) {
  std::vector<std::vector<std::string>> lines = {table.header};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<size_t> widths(table.header.size(), 0);
  for (const auto& line : lines)
    for (size_t column = 0; column < line.size(); ++column)
      widths[column] = std::max(widths[column], line[column].size());
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("{:<{}}", line[0], widths[0]);
    for (size_t column = 1; column < line.size(); ++column)
      text += fmt::format("  {:>{}}", line[column], widths[column]);
    text += "\n";
  }
  return text;
}

}  // namespace daumier::reports
