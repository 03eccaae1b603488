#include "systems/sketch/metrics.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

/// A report of an earlier version, without flags.
Json EarlierMetrics() {
  const auto row = [](const char* name, const char* input, double error) {
    return Json{{"name", name},
                {"shape_input", input},
                {"error", error},
                {"error_low", 1.0},
                {"error_high", 3.0},
                {"p50", 2.0},
                {"p90", 4.0},
                {"p99", 5.0},
                {"interocular_share", 0.03},
                {"face_errors_mm", {error - 1, error + 1}}};
  };
  return {{"shape_input", "recovered"},
          {"regions_mm", {{"nose", 2.0}}},
          {"table",
           {row("network", "given", 2), row("network", "recovered", 2.5), row("mean face", "none", 6),
            row("ridge on shape numbers", "given", 5)}},
          {"data_hash", {{"faces", "f"}}},
          {"faces", {3, 5}},
          {"groups", {0, 1}}};
}

TEST(SketchMetrics, ReportsOfEarlierVersionsAreRead) {
  const reports::MetricTable table = ReadSketchMetrics(EarlierMetrics());
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.result, 1u);
  EXPECT_EQ(table.rows[1].error().mean, 2.5);
  EXPECT_EQ(table.rows[1].details.at("regions_mm").at("nose"), 2.0);
  EXPECT_TRUE(table.rows[0].details.empty()) << "the regions are the result's";
  EXPECT_EQ(table.rows[0].face_errors, (std::vector<double>{1, 3}));
  EXPECT_EQ(table.faces, (std::vector<int>{3, 5}));
  EXPECT_EQ(table.groups, (std::vector<int>{0, 1}));
  EXPECT_EQ(table.data_hash.at("faces"), "f");
  EXPECT_TRUE(table.rows[2].baseline);
  for (const size_t row : {0, 1, 3}) EXPECT_FALSE(table.rows[row].baseline) << row;
}

TEST(SketchMetrics, FlagsCountBeforeNames) {
  Json metrics = EarlierMetrics();
  for (Json& row : metrics["table"]) row["baseline"] = row["name"] == "ridge on shape numbers";
  const reports::MetricTable table = ReadSketchMetrics(metrics);
  EXPECT_FALSE(table.rows[2].baseline);
  EXPECT_TRUE(table.rows[3].baseline);
}

TEST(SketchMetrics, TextHasTheColumnsOfTheDocuments) {
  const reports::ReportTable text = reports::TextTable(ReadSketchMetrics(EarlierMetrics()));
  EXPECT_EQ(text.header, (std::vector<std::string>{"predictor", "shape input", "mm", "95 % interval", "median", "p90",
                                                   "p99", "of eye distance"}));
  EXPECT_EQ(text.rows[0], (std::vector<std::string>{"network", "given", "2.000", "1.000 to 3.000", "2.000", "4.000",
                                                    "5.000", "3.00 %"}));
}

TEST(SketchMetrics, SummaryColumnsAreColumns) {
  for (const reports::Metric& column : SketchSummaryColumns())
    EXPECT_TRUE(reports::FindColumn(SketchColumns(), column.key).has_value()) << column.key;
}

TEST(SketchMetrics, RefusesWhatIsMalformed) {
  testing::ExpectError([] { ReadSketchMetrics(Json::object()); }, "malformed");
  Json metrics = EarlierMetrics();
  metrics["shape_input"] = "none";
  testing::ExpectError([&] { ReadSketchMetrics(metrics); }, "no row of the network with shape input 'none'");
}

}  // namespace
}  // namespace daumier::sketch
