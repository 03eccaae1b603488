#include "reports/report_page.h"

namespace daumier::reports {

std::string ReportPage(const ReportData& data) {
  std::vector<HtmlFigure> figures = {
      {"Samples", "sheet.png",
       "Each row: sketch, true face, predicted face, and the distance of each vertex from the true one. Grey is not "
       "counted."},
      {"Mean error", "mean_error.png",
       "The distance of each vertex from the true one, mean over all test faces, on the mean face."},
      {"Distribution of errors", "errors.svg",
       "Above: how many faces have which mean error. Below: the share of faces with at most that error."}};
  for (const ReportChart& chart : data.charts) figures.push_back({chart.title, chart.file, chart.caption});
  return PageHtml(
      {.title = data.title, .summary = data.summary, .tables = data.tables, .figures = figures, .facts = data.facts});
}

}  // namespace daumier::reports
