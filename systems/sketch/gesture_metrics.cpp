#include "systems/sketch/gesture_metrics.h"

namespace daumier::sketch {

const std::vector<reports::Metric>& GestureColumns() {
  static const std::vector<reports::Metric> columns = [] {
    const auto percent = [](const char* key, const char* title) {
      return reports::Metric{.key = key, .title = title, .unit = "%", .digits = 2, .scale = 100};
    };
    std::vector<reports::Metric> list = {percent("error", "of gestures wrong"), percent("missed", "rejected"),
                                         percent("none_accepted", "of other strokes accepted")};
    list[0].interval = reports::ShowInterval::kInColumn;
    list[0].interval_digits = 2;
    list[2].may_hide = true;
    return list;
  }();
  return columns;
}

std::vector<reports::Metric> GestureSummaryColumns() {
  std::vector<reports::Metric> columns(GestureColumns().begin() + 1, GestureColumns().end());
  for (reports::Metric& column : columns) column.may_hide = true;
  return columns;
}

}  // namespace daumier::sketch
