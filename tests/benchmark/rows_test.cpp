#include "benchmark/rows.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/results_pages.h"

#include <gtest/gtest.h>

namespace daumier::benchmark {
namespace {

/// A row of two persons with these errors.
Json RowWith(const std::string& name, double a, double b) {
  const auto item = [](const char* of_item, int person, double error) {
    return Json{{"name", of_item}, {"person", person}, {"predicted", true}, {"surface_error_mm", error}};
  };
  return {{"benchmark", "small"},
          {"kit_hash", "abc"},
          {"task", "drawings"},
          {"split", "test"},
          {"method", {{"name", name}, {"training_data", "split train"}}},
          {"num_items", 2},
          {"num_missing", 0},
          {"surface_error_mm", {{"mean", (a + b) / 2}, {"low", a}, {"high", b}, {"median", (a + b) / 2}, {"p90", b}}},
          {"items", {item("a", 0, a), item("b", 1, b)}}};
}

TEST(SummariseRows, OrdersThemAndComparesItemByItem) {
  const std::vector<Json> rows = {RowWith("worse", 3, 5), RowWith("better", 1, 2)};
  const Json summary = SummariseRows(rows);
  EXPECT_EQ(summary.at("rows").at(0).at("method").at("name"), "better");
  EXPECT_EQ(summary.at("rows").at(0).at("difference").at("mean"), 0);
  const Json difference = summary.at("rows").at(1).at("difference");
  EXPECT_NEAR(difference.at("mean").get<double>(), (2 + 3) / 2.0, 1e-12);
  EXPECT_GE(difference.at("low").get<double>(), 2);
  EXPECT_LE(difference.at("high").get<double>(), 3);
  EXPECT_FALSE(summary.at("rows").at(0).contains("items"));
  const reports::ReportTable table = RowsTable(summary);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][2], "1.50 (1.00 to 2.00)");
  EXPECT_EQ(table.rows[0][3], "-") << "no error of vertices";
  EXPECT_EQ(table.rows[1][7], "0 of 2");
}

TEST(SummariseRows, RefusesRowsOfAnotherKit) {
  std::vector<Json> rows = {RowWith("a", 3, 5), RowWith("b", 1, 2)};
  rows[1]["kit_hash"] = "def";
  testing::ExpectError([&] { SummariseRows(rows); }, "the row 'b' has kit_hash \"def\", but 'a' has \"abc\"");
  rows[1] = RowWith("b", 1, 2);
  rows[1]["items"].erase(0);
  testing::ExpectError([&] { SummariseRows(rows); }, "the row 'b' has 1 items of 2");
  rows[1] = Json::object();
  testing::ExpectError([&] { SummariseRows(rows); }, "no row of `daumier score --benchmark --json`");
  testing::ExpectError([] { SummariseRows({}); }, "there is no row");
}

TEST(BenchmarkResults, ShowTheTablesOfTheirRecords) {
  int num_records = 0;
  for (const auto& file : std::filesystem::directory_iterator(testing::ResultsFolder() / "benchmark")) {
    if (file.path().extension() != ".json") continue;
    ++num_records;
    testing::ExpectTableInResults("benchmark/" + file.path().filename().string(),
                                  reports::TableMarkdown(RowsTable(ReadJson(file.path()))));
  }
  EXPECT_GT(num_records, 0);
}

}  // namespace
}  // namespace daumier::benchmark
