#include "systems/portrait/landmark_metrics.h"

namespace daumier::portrait {
namespace {

reports::Metric PercentColumn(const char* key, const char* title) {
  return {.key = key, .title = title, .unit = "%", .digits = 2, .scale = 100};
}

}  // namespace

const std::vector<reports::Metric>& LandmarkColumns() {
  static const std::vector<reports::Metric> columns = [] {
    std::vector<reports::Metric> list = {PercentColumn("error", "of eye distance"),
                                         PercentColumn("p50", "median"),
                                         PercentColumn("p90", "p90"),
                                         PercentColumn("jaw", "jaw"),
                                         PercentColumn("brows", "brows"),
                                         PercentColumn("nose", "nose"),
                                         PercentColumn("eyes", "eyes"),
                                         PercentColumn("mouth", "mouth"),
                                         PercentColumn("found", "found")};
    list[0].interval = reports::ShowInterval::kInColumn;
    list[0].interval_digits = 2;
    list[1].of_key = list[2].of_key = "error";
    list[1].percentile = 50;
    list[2].percentile = 90;
    list.back().digits = 1;
    return list;
  }();
  return columns;
}

std::vector<reports::Metric> LandmarkSummaryColumns() {
  std::vector<reports::Metric> columns = {PercentColumn("p90", "p90"), PercentColumn("eyes", "eyes")};
  for (reports::Metric& column : columns) column.may_hide = true;
  return columns;
}

}  // namespace daumier::portrait
