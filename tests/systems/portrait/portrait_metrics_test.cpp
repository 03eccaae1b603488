#include "systems/portrait/portrait_metrics.h"

#include "systems/portrait/portrait_system.h"
#include "tests/support/expect_error.h"

namespace daumier::portrait {
namespace {

TEST(PortraitMetrics, ATableSurvivesJson) {
  reports::MetricTable table{
      .columns = PortraitColumns(), .faces = {3, 4}, .groups = {1, 2}, .data_hash = {{"portraits", "x"}}};
  table.rows.push_back(reports::MakeRow(
      table, kPortraitNetworkRow, {{"error", {1.5, 2.5}}, {"landmark_error", {0.02, 0.04}}, {"mouth", {1, 2}}}, 1));
  table.rows.push_back(reports::MakeRow(table, kMeanFaceRow, {{"error", {3, 5}}}, 1));
  const Json metrics = {{"table", reports::TableJson(table)},
                        {"faces", table.faces},
                        {"groups", table.groups},
                        {"data_hash", table.data_hash}};
  const reports::MetricTable read = PortraitSystem().read_metrics(metrics);
  ASSERT_EQ(read.rows.size(), 2U);
  EXPECT_NEAR(read.rows[0].error().mean, 2, 1e-12);
  EXPECT_EQ(read.rows[0].face_errors, (std::vector<double>{1.5, 2.5}));
  EXPECT_NEAR(*reports::ValueOf(read, read.rows[0], "landmark_error"), 0.03, 1e-12);
  EXPECT_FALSE(reports::ValueOf(read, read.rows[0], "photometric"));
  EXPECT_NEAR(reports::FindRow(read, kMeanFaceRow).error().mean, 4, 1e-12);
  EXPECT_EQ(read.groups, table.groups);
  EXPECT_EQ(read.data_hash, table.data_hash);
}

TEST(PortraitMetrics, WhatIsMalformedIsRefused) {
  testing::ExpectError([] { PortraitSystem().read_metrics(Json::object()); }, "malformed");
  testing::ExpectError(
      [] {
        PortraitSystem().read_metrics({{"table", Json::array()}, {"faces", "none"}});
      },
      "malformed");
}

TEST(PortraitMetrics, SummariesHaveAllColumnsBesidesTheErrorAndTheCount) {
  const std::vector<reports::Metric>& columns = PortraitColumns();
  EXPECT_EQ(columns.front().key, "error");
  EXPECT_EQ(columns.back().key, "num_images");
  const std::vector<reports::Metric> summary = PortraitSummaryColumns();
  ASSERT_EQ(summary.size(), columns.size() - 2);
  for (size_t c = 0; c < summary.size(); ++c) {
    EXPECT_EQ(summary[c].key, columns[c + 1].key);
    EXPECT_TRUE(summary[c].may_hide) << summary[c].key;
  }
}

}  // namespace
}  // namespace daumier::portrait
