#include "systems/sketch/parser_metrics.h"

#include "systems/sketch/system.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(ParserMetrics, ATableSurvivesJson) {
  reports::MetricTable table{
      .columns = ParserColumns(), .faces = {3, 4}, .groups = {1, 2}, .data_hash = {{"sketches", "x"}}};
  table.rows.push_back(reports::MakeRow(table, "parser", {{"error", {0.02, 0.04}}}, 1));
  const Json metrics = {{"table", reports::TableJson(table)},
                        {"faces", table.faces},
                        {"groups", table.groups},
                        {"data_hash", table.data_hash}};
  const reports::MetricTable read = ParserSystem().read_metrics(metrics);
  EXPECT_NEAR(read.rows[0].error().mean, 0.03, 1e-12);
  testing::ExpectError([] { ParserSystem().read_metrics(Json::object()); }, "malformed");
}

TEST(ParserMetrics, SummaryColumnsAreColumns) {
  for (const reports::Metric& column : ParserSummaryColumns())
    EXPECT_TRUE(reports::FindColumn(ParserColumns(), column.key)) << column.key;
}

}  // namespace
}  // namespace daumier::sketch
