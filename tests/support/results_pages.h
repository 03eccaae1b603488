#pragma once
#include "core/files.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

/// Tables of the pages docs/results/*.md. A table lies between the lines `<!-- table: NAME -->` and `<!-- end -->`. NAME
/// is a record, relative to docs/results, or "headline".
namespace daumier::testing {

inline std::filesystem::path ResultsFolder() {
  return SourceRoot() / "docs/results";
}

/// docs/results/*.md, sorted.
inline std::vector<std::filesystem::path> ResultsPages() {
  std::vector<std::filesystem::path> pages;
  for (const auto& file : std::filesystem::directory_iterator(ResultsFolder()))
    if (file.path().extension() == ".md") pages.push_back(file.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

/// The bytes [begin, end) of a page between the markers of a table.
struct TableBlock {
  std::filesystem::path page;
  std::string name;
  size_t begin = 0, end = 0;
};

/// The blocks of all pages, in order. A marker at the start of a line opens a block; a block without end fails the test.
inline std::vector<TableBlock> TableBlocks() {
  const std::string open = "\n<!-- table: ", close = " -->\n", end_line = "<!-- end -->\n";
  std::vector<TableBlock> blocks;
  for (const std::filesystem::path& page : ResultsPages()) {
    const std::string text = ReadFile(page);
    for (size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
      const size_t name_begin = at + open.size();
      const size_t name_end = text.find(close, name_begin);
      const size_t end = text.find(end_line, name_begin);
      if (name_end == std::string::npos || end == std::string::npos || name_end + close.size() > end) {
        ADD_FAILURE() << page << ": a table marker at byte " << at + 1 << " has no end";
        break;
      }
      blocks.push_back({page, text.substr(name_begin, name_end - name_begin), name_end + close.size(), end});
    }
  }
  return blocks;
}

/// Expects one block of that name, which holds `table` between two blank lines, on a page that contains `commands`.
/// If the environment variable DAUMIER_WRITE_DOCS is set, the block is rewritten before the comparison.
inline void ExpectTableInResults(const std::string& name, const std::string& table,
                                 const std::vector<std::string>& commands = {}) {
  std::vector<TableBlock> blocks = TableBlocks();
  std::erase_if(blocks, [&](const TableBlock& block) { return block.name != name; });
  ASSERT_EQ(blocks.size(), 1u) << "docs/results has " << blocks.size() << " tables " << name << " (expected 1)";
  const TableBlock& block = blocks.front();
  const std::string expected = "\n" + table + "\n";
  std::string text = ReadFile(block.page);
  const std::string found = text.substr(block.begin, block.end - block.begin);
  if (std::getenv("DAUMIER_WRITE_DOCS") != nullptr) {
    text.replace(block.begin, block.end - block.begin, expected);
    if (found != expected) WriteFileAtomically(block.page, text);
  } else {
    EXPECT_EQ(found, expected)
        << block.page << ": table " << name
        << " differs from its record. Rewrite it with DAUMIER_WRITE_DOCS=1 (docs/results/README.md)";
  }
  for (std::string command : commands) {
    // Runs were made with bfloat16 on a processor where `auto` chooses it; elsewhere the page's command has to work, too.
    if (const size_t at = command.find("precision=bfloat16"); at != std::string::npos)
      command.replace(at, 18, "precision=auto");
    EXPECT_NE(text.find(command), std::string::npos)
        << block.page << " lacks the command of " << name << ": " << command;
  }
}

}  // namespace daumier::testing
