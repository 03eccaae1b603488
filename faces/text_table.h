#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace daumier::faces {

/// Text in rows of cells, as programs write points: separated by semicolons, tabulators, commas or white space.
struct TextTable {
  struct Row {
    int line;  ///< 1-based.
    std::vector<std::string> cells;
  };
  std::vector<Row> rows;
  std::vector<std::string> remarks;  ///< Text of comments, and lines `key: value` in front of the rows.
  bool is_delimited = false;         ///< By a sign; else by white space.
};

/// Splits text into rows. Lines end with LF, CR LF or CR; a byte order mark is skipped. Comments begin with #, // or ;
/// and may follow numbers. Braces alone on a line are skipped. Cells may be in double quotes.
/// @throws Error naming file and line: binary or UTF-16 text, or numbers with decimal commas.
TextTable ReadTextTable(std::string_view text, const std::string& name);

}  // namespace daumier::faces
