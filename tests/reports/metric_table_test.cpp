#include "reports/metric_table.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::reports {
namespace {

using testing::ExpectError;

/// Four faces of two persons.
MetricTable FourFaces() {
  return {.columns = {{.key = "error", .title = "mm", .unit = "mm", .interval = ShowInterval::kInColumn},
                      {.key = "p90", .title = "p90", .digits = 1, .of_key = "error", .percentile = 90},
                      {.key = "share", .title = "share", .unit = "%", .digits = 2, .scale = 100, .may_hide = true}},
          .faces = {3, 5, 7, 9},
          .groups = {0, 0, 1, 1}};
}

MetricTable TwoRows() {
  MetricTable table = FourFaces();
  table.rows = {MakeRow(table, "network", {{"error", {1, 2, 3, 4}}, {"share", {0.25, 0.75}}}, 1),
                MakeRow(table, "mean face", {{"error", {4, 4, 4, 4}}}, 1)};
  table.rows[0].input = "given";
  table.rows[1].baseline = true;
  return table;
}

TEST(MetricTable, ARowHoldsMeansPercentilesAndIntervalsByPerson) {
  const MetricTable table = TwoRows();
  const MetricRow& row = table.rows[0];
  EXPECT_EQ(row.error().mean, 2.5);
  EXPECT_EQ(row.error().interval->low, 1.5) << "of two persons, both draws can be the first";
  EXPECT_EQ(row.error().interval->high, 3.5);
  EXPECT_NEAR(*ValueOf(table, row, "p90"), 3.7, 1e-12);
  EXPECT_EQ(ValueOf(table, row, "share"), 0.5) << "of the faces on which it was measured";
  EXPECT_EQ(ValueOf(table, table.rows[1], "share"), std::nullopt);
  EXPECT_EQ(ValueOf(table, row, "absent"), std::nullopt);
  EXPECT_EQ(row.face_errors, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_FALSE(row.values[1]->interval.has_value());
}

TEST(MetricTable, ARowOfTheFirstFacesHasTheirPersons) {
  const MetricRow row = MakeRow(FourFaces(), "two faces", {{"error", {1, 3}}}, 1);
  EXPECT_EQ(row.error().mean, 2);
  EXPECT_EQ(row.error().interval->low, 2) << "one person alone has no spread";
}

TEST(MetricTable, RefusesNumbersThatAreNotFiniteNamingTheRow) {
  ExpectError(
      [] {
        MakeRow(FourFaces(), "network", {{"error", {1, std::nan(""), 3, 4}}}, 1);
      },
      "row 'network', 'error' of faces: ");
  ExpectError([] { MakeRow(FourFaces(), "network", {{"error", {1}}, {"share", {INFINITY}}}, 1); }, "'share'");
  ExpectError([] { MakeRow(FourFaces(), "network", {{"error", {1, 2, 3, 4, 5}}}, 1); }, "5 numbers of 4 faces");
  ExpectError([] { MakeRow(FourFaces(), "network", {{"error", {}}}, 1); }, "row 'network'");
}

TEST(MetricTable, AnErrorThatWasNotMeasuredIsNamed) {
  const MetricRow row = MakeRow(FourFaces(), "network", {{"share", {0.5}}}, 1);
  ExpectError([&] { row.error(); }, "the error of 'network'");
}

TEST(MetricTable, FindsRowsByNameAndInput) {
  MetricTable table = TwoRows();
  table.rows.push_back(table.rows[0]);
  table.rows[2].input = "recovered";
  table.result = 2;
  EXPECT_EQ(&FindRow(table, ""), &table.rows[2]);
  EXPECT_EQ(&FindRow(table, "network"), &table.rows[2]) << "the result before its namesakes";
  EXPECT_EQ(&FindRow(table, "network", "given"), &table.rows[0]);
  EXPECT_EQ(&FindRow(table, "", "given"), &table.rows[0]);
  EXPECT_EQ(&FindRow(table, "mean face"), &table.rows[1]);
  ExpectError([&] { FindRow(table, "ridge"); }, "no row 'ridge'; rows are: network (given), mean face, network");
  ExpectError([&] { FindRow(table, "mean face", "given"); }, "no row 'mean face' of input 'given'");
  ExpectError([] { FindRow(FourFaces(), ""); }, "0 rows");
}

TEST(MetricTable, JsonHasTheKeysOfItsColumns) {
  const Json list = TableJson(TwoRows());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["name"], "network");
  EXPECT_EQ(list[0]["shape_input"], "given");
  EXPECT_FALSE(list[1].contains("shape_input"));
  EXPECT_EQ(list[1]["baseline"], true);
  EXPECT_EQ(list[0]["error"], 2.5);
  EXPECT_EQ(list[0]["error_low"], 1.5);
  EXPECT_EQ(list[0]["error_high"], 3.5);
  EXPECT_EQ(list[0]["share"], 0.5);
  EXPECT_TRUE(list[1]["share"].is_null());
  EXPECT_EQ(list[0]["face_errors_mm"], Json::array({1.0, 2.0, 3.0, 4.0}));
  MetricTable in_units = TwoRows();
  in_units.columns[0].unit = "model units";
  in_units.rows[0].details = {{"regions", {{"nose", 1.0}}}};
  EXPECT_EQ(TableJson(in_units)[0]["face_errors"].size(), 4u);
  EXPECT_EQ(TableJson(in_units)[0]["regions"]["nose"], 1.0);
}

TEST(MetricTable, RowsFromJsonUndoesJson) {
  const MetricTable table = TwoRows();
  MetricTable again = FourFaces();
  again.rows = RowsFromJson(Json::parse(TableJson(table).dump()), table.columns);
  EXPECT_EQ(TableJson(again), TableJson(table));
}

TEST(MetricTable, RowsOfEarlierReportsMayLackEntriesButNotTheError) {
  const std::vector<Metric> columns = FourFaces().columns;
  const std::vector<MetricRow> rows = RowsFromJson(Json::parse(R"([{"name": "a", "error": 2.0}])"), columns);
  EXPECT_EQ(rows[0].error().mean, 2.0);
  EXPECT_FALSE(rows[0].error().interval.has_value());
  EXPECT_FALSE(rows[0].values[1].has_value());
  EXPECT_TRUE(rows[0].face_errors.empty());
  ExpectError([&] { RowsFromJson(Json::parse(R"([{"name": "a"}])"), columns); }, "malformed");
  ExpectError([&] { RowsFromJson(Json::parse(R"([{"name": "a", "error": "two"}])"), columns); }, "malformed");
}

TEST(MetricTable, MetricsOfAReportAreReadAsTheirTable) {
  MetricTable table = TwoRows();
  table.faces = {3, 4, 6, 7};
  table.data_hash = {{"faces", "f"}};
  const Json metrics = {
      {"table", TableJson(table)}, {"faces", table.faces}, {"groups", table.groups}, {"data_hash", table.data_hash}};
  const MetricTable read = TableFromMetrics(Json::parse(metrics.dump()), table.columns, "a run");
  EXPECT_EQ(TableJson(read), TableJson(table));
  EXPECT_EQ(read.faces, table.faces);
  EXPECT_EQ(read.groups, table.groups);
  EXPECT_EQ(read.data_hash, table.data_hash);
}

TEST(MetricTable, MetricsMayLackFacesAndGroupsButNothingElse) {
  const std::vector<Metric> columns = TwoRows().columns;
  const Json metrics = {{"table", TableJson(TwoRows())}, {"data_hash", "f"}};
  EXPECT_TRUE(TableFromMetrics(metrics, columns, "a run").faces.empty());
  for (const char* key : {"table", "data_hash"}) {
    Json less = metrics;
    less.erase(key);
    ExpectError([&] { TableFromMetrics(less, columns, "a run"); }, "the metrics of a run are malformed");
  }
  Json other = metrics;
  other["faces"] = "none";
  ExpectError([&] { TableFromMetrics(other, columns, "a run"); }, "the metrics of a run are malformed");
}

TEST(MetricTable, TextHasAColumnAMetricAndItsInterval) {
  const ReportTable text = TextTable(TwoRows());
  EXPECT_EQ(text.header, (std::vector<std::string>{"predictor", "shape input", "mm", "95 % interval", "p90", "share"}));
  EXPECT_EQ(text.rows[0], (std::vector<std::string>{"network", "given", "2.500", "1.500 to 3.500", "3.7", "50.00 %"}));
  EXPECT_EQ(text.rows[1], (std::vector<std::string>{"mean face", "-", "4.000", "4.000 to 4.000", "4.0", "-"}));
}

TEST(MetricTable, TextHasNoIntervalOfOnePerson) {
  MetricTable table = TwoRows();
  table.rows.push_back(MakeRow(table, "two faces", {{"error", {1, 3}}}, 1));
  ReportTable text = TextTable(table);
  EXPECT_EQ(text.rows[0][3], "1.500 to 3.500");
  EXPECT_EQ(text.rows[2][2], "2.000");
  EXPECT_EQ(text.rows[2][3], "-") << "both are of the first person";
  table.groups = {1, 1, 1, 1};
  text = TextTable(table);
  EXPECT_EQ(text.rows[0][3], "-");
}

TEST(MetricTable, TextLeavesOutWhatNoRowHas) {
  MetricTable table = TwoRows();
  table.rows.erase(table.rows.begin());
  table.columns[0].interval = ShowInterval::kInCell;
  table.columns[0].interval_digits = 1;
  table.columns[0].sign = true;
  const ReportTable text = TextTable(table, "Split: person", "row");
  EXPECT_EQ(text.header, (std::vector<std::string>{"row", "mm", "p90"}));
  EXPECT_EQ(text.rows[0], (std::vector<std::string>{"mean face", "+4.000 (+4.0 to +4.0)", "4.0"}));
}

}  // namespace
}  // namespace daumier::reports
