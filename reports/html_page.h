#pragma once
#include "reports/report_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace daumier::reports {

struct ReportFact {
  std::string name, value;  ///< "seed", "7".
};

/// A picture in the page's folder.
struct HtmlFigure {
  std::string title, file, caption;
};

struct HtmlPage {
  std::string title;
  std::string summary;  ///< A sentence or two below the title.
  std::vector<ReportTable> tables = {};
  std::vector<HtmlFigure> figures = {};
  std::vector<ReportFact> facts = {};
};

/// The text with &, <, >, " and ' replaced by entities, so that it is valid in HTML between tags and in quotes.
std::string EscapeHtml(std::string_view text);

/// A page that needs nothing from elsewhere but its pictures: title and summary, tables, pictures, facts. All text is
/// escaped. It has a light and a dark look and fits a telephone's width.
std::string PageHtml(const HtmlPage& page);

}  // namespace daumier::reports
