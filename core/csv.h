#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace daumier {

/// A row of comma-separated cells.
struct CsvRow {
  int line;  ///< On which it begins, 1-based.
  std::vector<std::string> cells;
};

/// Rows of comma-separated text [RFC 4180]: cells in double quotes may hold commas, line ends and, doubled, quotes. Lines end with LF or CR LF; a
/// byte order mark and empty lines are skipped. Nothing is guessed or trimmed, unlike faces::ReadTextTable of files of unknown programs.
/// @throws Error "name:line: ..." where a quote is not closed.
std::vector<CsvRow> ParseCsv(std::string_view text, const std::string& name);

/// A finite number of a cell. @throws Error "name:line: ..." if it is none.
double CsvNumber(const CsvRow& row, size_t cell, const std::string& name);

/// A cell as ParseCsv reads it back: in quotes where it holds a comma, a quote or a line end.
std::string CsvCell(std::string_view text);

}  // namespace daumier
