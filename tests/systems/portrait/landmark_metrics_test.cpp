#include "systems/portrait/landmark_metrics.h"

#include "systems/portrait/system.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkMetrics, ATableSurvivesJson) {
  reports::MetricTable table{
      .columns = LandmarkColumns(), .faces = {3, 4}, .groups = {1, 2}, .data_hash = {{"portraits", "x"}}};
  reports::FaceValues values;
  for (const char* key : {"error", "jaw", "brows", "nose", "eyes", "mouth"}) values[key] = {0.02, 0.04};
  table.rows.push_back(reports::MakeRow(table, "network", values, 1));
  const Json metrics = {{"table", reports::TableJson(table)},
                        {"faces", table.faces},
                        {"groups", table.groups},
                        {"data_hash", table.data_hash}};
  const reports::MetricTable read = LandmarkSystem().read_metrics(metrics);
  EXPECT_NEAR(read.rows[0].error().mean, 0.03, 1e-12);
  testing::ExpectError([] { LandmarkSystem().read_metrics(Json::object()); }, "malformed");
}

}  // namespace
}  // namespace daumier::portrait
