#include "core/csv.h"

#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace daumier {
namespace {

/// Takes a cell in quotes from the front of the text, which begins with one. Counts the lines that end in it.
std::string TakeQuoted(std::string_view& text, int& line, const std::string& name, int first_line) {
  std::string cell;
  text.remove_prefix(1);
  while (true) {
    DAUMIER_CHECK(!text.empty(), "{}:{}: a quote is not closed", name, first_line);
    const char c = text.front();
    text.remove_prefix(1);
    if (c == '"' && !text.starts_with('"')) return cell;
    if (c == '"') text.remove_prefix(1);
    line += c == '\n';
    cell += c;
  }
}

}  // namespace

std::vector<CsvRow> ParseCsv(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<CsvRow> rows;
  for (int line = 1; !text.empty(); ++line) {
    CsvRow row{line, {}};
    bool ends = false;
    while (!ends) {
      std::string cell;
      if (text.starts_with('"')) cell = TakeQuoted(text, line, name, row.line);
      const size_t end = std::min(text.find_first_of(",\n"), text.size());
      ends = end == text.size() || text[end] == '\n';
      std::string_view plain = text.substr(0, end);
      if (ends && plain.ends_with('\r')) plain.remove_suffix(1);  // Of the line's end; one in quotes is the cell's.
      cell += plain;
      text.remove_prefix(std::min(end + 1, text.size()));
      row.cells.push_back(std::move(cell));
    }
    if (row.cells.size() > 1 || !row.cells.front().empty()) rows.push_back(std::move(row));
  }
  return rows;
}

double CsvNumber(const CsvRow& row, size_t cell, const std::string& name) {
  DAUMIER_CHECK(cell < row.cells.size(), "{}:{}: {} cells, expected {} or more", name, row.line, row.cells.size(),
                cell + 1);
  const std::string& text = row.cells[cell];
  double number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  DAUMIER_CHECK(failure == std::errc() && end == text.data() + text.size() && std::isfinite(number),
                "{}:{}: cell {} is '{}', expected a number", name, row.line, cell + 1, text.substr(0, 40));
  return number;
}

std::string CsvCell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace daumier
