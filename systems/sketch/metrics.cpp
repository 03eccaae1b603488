#include "systems/sketch/metrics.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

/// Reports of earlier versions have no flags.
void FlagBaselines(reports::MetricTable& table) {
  const auto flagged = [](const reports::MetricRow& row) { return row.baseline; };
  if (std::any_of(table.rows.begin(), table.rows.end(), flagged)) return;
  for (reports::MetricRow& row : table.rows)
    row.baseline =
        row.name == kMeanFace || row.name == kNearestNeighbour || row.name == kRidge || row.name == kModelLimit;
}

}  // namespace

const std::vector<reports::Metric>& SketchColumns() {
  static const std::vector<reports::Metric> columns = {
      {.key = "error", .title = "mm", .unit = "mm", .interval = reports::ShowInterval::kInColumn},
      {.key = "p50", .title = "median", .of_key = "error", .percentile = 50},
      {.key = "p90", .title = "p90", .of_key = "error", .percentile = 90},
      {.key = "p99", .title = "p99", .of_key = "error", .percentile = 99},
      {.key = "interocular_share", .title = "of eye distance", .unit = "%", .digits = 2, .scale = 100}};
  return columns;
}

std::vector<reports::Metric> SketchSummaryColumns() {
  return {{.key = "p90", .title = "p90", .may_hide = true}};
}

reports::MetricTable ReadSketchMetrics(const Json& metrics) {
  try {
    reports::MetricTable table = reports::TableFromMetrics(metrics, SketchColumns(), "a sketch run");
    FlagBaselines(table);
    const std::string input = metrics.at("shape_input").get<std::string>();
    const auto result = std::find_if(table.rows.begin(), table.rows.end(), [&](const reports::MetricRow& row) {
      return row.name == table.rows.front().name && row.input == input;
    });
    DAUMIER_CHECK(result != table.rows.end(), "the table has no row of the network with shape input '{}'", input);
    table.result = size_t(result - table.rows.begin());
    result->details["regions_mm"] = metrics.value("regions_mm", Json());
    return table;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of a sketch run are malformed: {}", TextOf(error)));
  }
}

}  // namespace daumier::sketch
