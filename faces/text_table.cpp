#include "faces/text_table.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>

namespace daumier::faces {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view Trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}

/// `Version 1.0`, without a sign between.
bool IsVersion(std::string_view line) {
  constexpr std::string_view kVersion = "version";
  if (line.size() <= kVersion.size() || kBlanks.find(line[kVersion.size()]) == std::string_view::npos) return false;
  const bool is_word = std::equal(kVersion.begin(), kVersion.end(), line.begin(),
                                  [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
  return is_word && Trimmed(line.substr(kVersion.size())).find_first_not_of("0123456789.") == std::string_view::npos;
}

struct Line {
  int number;
  std::string_view text;
};

std::vector<Line> SplitLines(std::string_view text) {
  std::vector<Line> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back({static_cast<int>(lines.size()) + 1, text.substr(0, end)});
    const bool is_pair = text.substr(end).starts_with("\r\n");
    text.remove_prefix(std::min(end + (is_pair ? 2 : 1), text.size()));
  }
  return lines;
}

/// `key: value` or `key = value` of a header; a name before coordinates is none.
bool IsHeaderEntry(std::string_view line) {
  const size_t end = line.find_first_of(":=");
  if (end == 0 || end == std::string_view::npos) return false;
  const std::string_view key = line.substr(0, end);
  const bool is_name = std::all_of(key.begin(), key.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ' ' || c == '-'; });
  return is_name && !IsDigit(key[0]) && key[0] != '-' &&
         Trimmed(line.substr(end + 1)).find_first_of(" \t,;") == std::string_view::npos;
}

/// Where a comment begins that follows cells. Between signs a # may belong to a name: only one behind a number counts.
size_t CommentBegin(std::string_view line, bool is_delimited) {
  for (size_t i = 1; i < line.size(); ++i) {
    if (kBlanks.find(line[i - 1]) == std::string_view::npos) continue;
    if (line[i] != '#' && !line.substr(i).starts_with("//")) continue;
    const std::string_view before = Trimmed(line.substr(0, i));
    if (!is_delimited || (!before.empty() && (IsDigit(before.back()) || before.back() == '.'))) return i;
  }
  return line.size();
}

bool HasDecimalComma(std::string_view cell) {
  const size_t comma = cell.find(',');
  if (comma == 0 || comma == std::string_view::npos || comma + 1 == cell.size()) return false;
  const auto all_digits = [](std::string_view part) { return std::all_of(part.begin(), part.end(), IsDigit); };
  std::string_view whole = cell.substr(0, comma), share = cell.substr(comma + 1);
  if (whole[0] == '-' || whole[0] == '+') whole.remove_prefix(1);
  if (const size_t exponent = share.find_first_of("eE"); exponent != std::string_view::npos)
    share = share.substr(0, exponent);
  return !whole.empty() && !share.empty() && all_digits(whole) && all_digits(share);
}

/// Cells of a line; separator ' ' is any run of white space.
std::vector<std::string> SplitCells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::string cell;
  bool is_quoted = false, is_begun = false;
  const auto finish = [&] {
    cells.emplace_back(Trimmed(cell));
    cell.clear();
    is_begun = false;
  };
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
      is_begun = true;
    } else if (!is_quoted && (separator == ' ' ? kBlanks.find(c) != std::string_view::npos : c == separator)) {
      if (separator != ' ' || is_begun) finish();
    } else {
      cell += c;
      is_begun = true;
    }
  }
  if (separator != ' ' || is_begun) finish();
  return cells;
}

/// Of a whole line; ; may also be an empty first cell.
bool IsComment(std::string_view trimmed) {
  return trimmed.starts_with('#') || trimmed.starts_with("//");
}

/// Tabulators separate cells, rather than being white space, where no cell contains blanks.
bool IsCutByTabulators(std::string_view line) {
  const auto cells = SplitCells(line, '\t');
  return cells.size() > 1 && std::none_of(cells.begin(), cells.end(), [](const std::string& cell) {
           return cell.find(' ') != std::string::npos && SplitCells(cell, ' ').size() > 1 && IsDigit(cell.back());
         });
}

char FindSeparator(const std::vector<Line>& lines) {
  size_t num_semicolons = 0, num_tabulators = 0, num_commas = 0, num_lines = 0;
  for (const auto& [number, line] : lines) {
    if (IsComment(Trimmed(line))) continue;
    const std::string_view cells = line.substr(0, CommentBegin(line, true));
    ++num_lines;
    num_semicolons += cells.find(';', 1) != std::string_view::npos;
    num_tabulators += IsCutByTabulators(cells);
    num_commas += cells.find(',') != std::string_view::npos;
  }
  if (2 * num_semicolons > num_lines) return ';';
  if (2 * num_tabulators > num_lines) return '\t';
  return 2 * num_commas > num_lines ? ',' : ' ';
}

void CheckNoDecimalCommas(const std::vector<std::string>& cells, const std::string& name, int line) {
  for (const std::string& cell : cells) {
    DAUMIER_CHECK(!HasDecimalComma(cell),
                  "{}: line {}: '{}' has a decimal comma (expected a point, as in 1.5). Save the file with points, "
                  "or replace the commas",
                  name, line, cell);
  }
}

}  // namespace

TextTable ReadTextTable(std::string_view text, const std::string& name) {
  DAUMIER_CHECK(!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF"),
                "{}: is UTF-16 text (expected UTF-8). Save it as UTF-8", name);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  DAUMIER_CHECK(text.find('\0') == std::string_view::npos, "{}: is binary (expected text with points)", name);

  TextTable table;
  std::vector<Line> lines;
  for (const Line& line : SplitLines(text)) {
    const std::string_view trimmed = Trimmed(line.text);
    if (trimmed.empty() || trimmed == "{" || trimmed == "}") continue;
    if (lines.empty() && (IsHeaderEntry(trimmed) || IsVersion(trimmed))) {
      table.remarks.emplace_back(trimmed);
    } else {
      lines.push_back(line);
    }
  }
  const char separator = FindSeparator(lines);
  table.is_delimited = separator != ' ';
  for (const auto& [number, line] : lines) {
    const std::string_view trimmed = Trimmed(line);
    if (IsComment(trimmed) || (trimmed.starts_with(';') && separator != ';')) {
      table.remarks.emplace_back(Trimmed(trimmed.substr(std::min(trimmed.find_first_not_of("#/;"), trimmed.size()))));
      continue;
    }
    // Between tabulators, blanks at the ends are cells.
    const std::string_view whole = separator == '\t' ? line : trimmed;
    const std::string_view cells = whole.substr(0, CommentBegin(whole, table.is_delimited));
    if (separator == ',') {
      // Between blanks, "1,5 2,5" are decimal commas; "1, 2" is not.
      const std::vector<std::string> words = SplitCells(cells, ' ');
      if (words.size() > 1 && std::all_of(words.begin(), words.end(), HasDecimalComma))
        CheckNoDecimalCommas(words, name, number);
    }
    DAUMIER_CHECK(std::count(cells.begin(), cells.end(), '"') % 2 == 0, "{}: line {}: a double quote is not closed",
                  name, number);
    std::vector<std::string> row = SplitCells(cells, separator);
    if (separator != ',') CheckNoDecimalCommas(row, name, number);
    table.rows.push_back({number, std::move(row)});
  }
  return table;
}

}  // namespace daumier::faces
