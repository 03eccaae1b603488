#include "reports/html_page.h"

#include <fmt/format.h>

namespace daumier::reports {
namespace {

constexpr const char* kPageStyle = R"(
:root { color-scheme: light dark; --ink: #24242a; --soft: #66666e; --line: #dcdce0; --paper: #fff; --card: #f6f5f2; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8ea; --soft: #a2a2aa; --line: #3a3a42; --paper: #17171a; --card: #212126; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 70rem; padding: 2rem 1rem 4rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0 0 .5rem; overflow-wrap: anywhere; }
h2 { font-size: 1.1rem; margin: 2.25rem 0 .6rem; }
.summary { color: var(--soft); max-width: 46rem; margin: 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .9rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
figure { margin: 0; }
figcaption { color: var(--soft); font-size: .9rem; margin-top: .4rem; }
img { display: block; max-width: 100%; height: auto; border: 1px solid var(--line); border-radius: 6px; }
img[src$=".svg"] { width: 40rem; }
dl { display: grid; grid-template-columns: minmax(8rem, max-content) 1fr; gap: .3rem 1.2rem; margin: 0;
  padding: 1rem; background: var(--card); border-radius: 6px; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
@media (max-width: 34rem) { dl { grid-template-columns: 1fr; gap: 0; } dd { margin-bottom: .6rem; } }
)";

std::string Cells(const std::vector<std::string>& row, std::string_view tag) {
  std::string html = "<tr>";
  for (const std::string& cell : row) html += fmt::format("<{0}>{1}</{0}>", tag, EscapeHtml(cell));
  return html + "</tr>\n";
}

std::string TableHtml(const ReportTable& table) {
  std::string html = fmt::format("<h2>{}</h2>\n<div class=\"scroll\"><table>\n<thead>{}</thead>\n<tbody>\n",
                                 EscapeHtml(table.title), Cells(table.header, "th"));
  for (const auto& row : table.rows) html += Cells(row, "td");
  return html + "</tbody>\n</table></div>\n";
}

std::string FigureHtml(const HtmlFigure& figure) {
  return fmt::format(
      "<h2>{0}</h2>\n<figure><a href=\"{1}\"><img src=\"{1}\" alt=\"{0}\"></a>\n"
      "<figcaption>{2}</figcaption></figure>\n",
      EscapeHtml(figure.title), EscapeHtml(figure.file), EscapeHtml(figure.caption));
}

std::string FactsHtml(const std::vector<ReportFact>& facts) {
  std::string html = "<h2>Facts</h2>\n<dl>\n";
  for (const ReportFact& fact : facts)
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", EscapeHtml(fact.name), EscapeHtml(fact.value));
  return html + "</dl>\n";
}

}  // namespace

std::string EscapeHtml(std::string_view text) {
  std::string html;
  for (const char character : text) {
    switch (character) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += character;
    }
  }
  return html;
}

std::string PageHtml(const HtmlPage& page) {
  const std::string title = EscapeHtml(page.title);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n<p class=\"summary\">{}</p>\n",
      title, kPageStyle, title, EscapeHtml(page.summary));
  for (const ReportTable& table : page.tables) html += TableHtml(table);
  for (const HtmlFigure& figure : page.figures) html += FigureHtml(figure);
  if (!page.facts.empty()) html += FactsHtml(page.facts);
  return html + "</body>\n</html>\n";
}

}  // namespace daumier::reports
