#include "systems/portrait/portrait_metrics.h"

namespace daumier::portrait {

const std::vector<reports::Metric>& PortraitColumns() {
  static const std::vector<reports::Metric> columns = {
      {.key = "error",
       .title = "mm",
       .unit = "mm",
       .digits = 2,
       .interval = reports::ShowInterval::kInColumn,
       .interval_digits = 2},
      {.key = "landmark_error", .title = "landmarks", .unit = "%", .digits = 2, .scale = 100},
      {.key = "angle_error", .title = "pose, degrees", .digits = 2},
      {.key = "photometric", .title = "colours", .digits = 3, .may_hide = true},
      {.key = "closed_eyes", .title = "closed eyes, mm", .digits = 2, .may_hide = true},
      {.key = "wink", .title = "winks, mm", .digits = 2, .may_hide = true},
      {.key = "mouth", .title = "mouths, mm", .digits = 2},
      {.key = "ms", .title = "ms a picture", .digits = 1, .may_hide = true},
      {.key = "num_images", .title = "pictures", .digits = 0}};
  return columns;
}

std::vector<reports::Metric> PortraitSummaryColumns() {
  std::vector<reports::Metric> columns(PortraitColumns().begin() + 1, PortraitColumns().end() - 1);
  for (reports::Metric& column : columns) column.may_hide = true;
  return columns;
}

}  // namespace daumier::portrait
