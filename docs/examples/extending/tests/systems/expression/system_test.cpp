#include "systems/expression/system.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::expression {
namespace {

TEST(ExpressionSystem, FillsInOptionsAndRefusesUnknownOnes) {
  const systems::System system = ExpressionSystem();
  const Json config = system.resolve_config({{"data", {{"faces", "/faces"}}}, {"network", {{"hidden", 8}}}}, "a.toml");
  EXPECT_EQ(config.at("network").at("hidden"), 8);
  EXPECT_EQ(config.at("system"), "expression");
  testing::ExpectError([&] { system.resolve_config({{"hiden", 8}}, "a.toml"); }, "hiden");
  testing::ExpectError([&] { system.resolve_config(Json::object(), "a.toml"); }, "it needs data.faces=FOLDER");
}

TEST(ExpressionSystem, ReadsTheTableThatAnEvaluationWrites) {
  reports::MetricTable table{.columns = ErrorColumns(), .faces = {3, 4}, .groups = {0, 1}, .data_hash = "abc"};
  table.rows = {reports::MakeRow(table, "network", {{"error", {0, 1}}}, 1)};
  const Json metrics = {
      {"table", reports::TableJson(table)}, {"faces", table.faces}, {"groups", table.groups}, {"data_hash", "abc"}};
  EXPECT_EQ(ExpressionSystem().read_metrics(metrics).rows.front().error().mean, 0.5);
}

}  // namespace
}  // namespace daumier::expression
