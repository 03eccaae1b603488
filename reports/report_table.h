#pragma once
#include <string>
#include <vector>

namespace daumier::reports {

/// Rows of text; the first column is set to the left, the others to the right.
struct ReportTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A Markdown table with a header line, without the title.
std::string TableMarkdown(const ReportTable& table);
/// Aligned columns for a terminal, with a header line, without the title.
std::string TableText(const ReportTable& table);

}  // namespace daumier::reports
