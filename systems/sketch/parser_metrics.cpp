#include "systems/sketch/parser_metrics.h"

#include "systems/sketch/parser_errors.h"

namespace daumier::sketch {
namespace {

reports::Metric PercentColumn(const std::string& key, const std::string& title) {
  return {.key = key, .title = title, .unit = "%", .digits = 2, .scale = 100};
}

}  // namespace

const std::vector<reports::Metric>& ParserColumns() {
  static const std::vector<reports::Metric> columns = [] {
    std::vector<reports::Metric> list = {PercentColumn("error", "of eye distance"), PercentColumn("p50", "median"),
                                         PercentColumn("p90", "p90")};
    list[0].interval = reports::ShowInterval::kInColumn;
    list[0].interval_digits = 2;
    list[1].of_key = list[2].of_key = "error";
    list[1].percentile = 50;
    list[2].percentile = 90;
    for (const PointPart& part : PointParts()) {
      list.push_back(PercentColumn(std::string(part.name), std::string(part.name)));
      list.back().may_hide = true;
    }
    return list;
  }();
  return columns;
}

std::vector<reports::Metric> ParserSummaryColumns() {
  std::vector<reports::Metric> columns = {PercentColumn("p90", "p90"), PercentColumn("eyes", "eyes")};
  for (reports::Metric& column : columns) column.may_hide = true;
  return columns;
}

}  // namespace daumier::sketch
