#include "ablation/measure.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::ablation {
namespace {

/// Two faces, of which the second row measures one.
reports::MetricTable Table() {
  reports::MetricTable table{.columns = {{.key = "error", .title = "mm", .unit = "mm"},
                                         {.key = "p90", .title = "p90", .of_key = "error", .percentile = 90},
                                         {.key = "flips", .title = "flips"}},
                             .faces = {3, 5},
                             .groups = {0, 1},
                             .data_hash = {{"faces", "f"}}};
  table.rows = {MakeRow(table, "network", {{"error", {1, 3}}}, 1), MakeRow(table, "network, fast", {{"error", {2}}}, 1),
                MakeRow(table, "network", {{"error", {5, 6}}}, 1)};
  table.rows[0].input = "recovered";
  table.rows[0].details = {{"regions_mm", {{"nose", 2.0}}}};
  table.rows[2].input = "given";
  return table;
}

TEST(MeasureOf, HoldsEveryColumnAndDetailByItsKey) {
  const reports::MetricTable table = Table();
  const AblationMeasure measure = MeasureOf(table, table.rows[0]);
  EXPECT_EQ(measure.error, 2);
  EXPECT_NEAR(measure.more.at("p90").get<double>(), 2.8, 1e-12);
  EXPECT_TRUE(measure.more.at("flips").is_null());
  EXPECT_EQ(measure.more.at("shape_input"), "recovered");
  EXPECT_EQ(measure.more.at("regions_mm").at("nose"), 2.0);
  EXPECT_EQ(measure.more.at("num_faces"), 2);
  EXPECT_EQ(measure.more.at("data_hash").at("faces"), "f");
  EXPECT_EQ(measure.face_errors, (std::vector<double>{1, 3}));
  EXPECT_EQ(measure.groups, (std::vector<int>{0, 1}));
}

TEST(MeasureOf, RowsOfTheNetworkHaveTheCostOfTheRunAndOneOfThemIsTheResult) {
  const reports::MetricTable table = Table();
  EXPECT_TRUE(MeasureOf(table, table.rows[0]).is_result);
  EXPECT_TRUE(MeasureOf(table, table.rows[2]).of_run);
  EXPECT_FALSE(MeasureOf(table, table.rows[2]).is_result);
  EXPECT_FALSE(MeasureOf(table, table.rows[1]).of_run);
}

TEST(MeasureOf, ARowOfSomeFacesIsNotCompared) {
  const reports::MetricTable table = Table();
  const AblationMeasure measure = MeasureOf(table, table.rows[1]);
  EXPECT_EQ(measure.more.at("num_faces"), 1);
  EXPECT_TRUE(measure.face_errors.empty());
}

TEST(MeasureOf, RefusesReportsWithoutErrorsOfFaces) {
  reports::MetricTable table = Table();
  table.rows[0].face_errors.clear();
  testing::ExpectError([&] { MeasureOf(table, table.rows[0]); }, "of an earlier version");
}

TEST(TestSetId, DiffersBetweenSetsOfFaces) {
  Json metrics = {{"num_faces", 2}, {"split", "test"}, {"faces", {3, 5}}, {"data_hash", {{"faces", "f"}}}};
  const std::string id = TestSetId(metrics);
  EXPECT_EQ(TestSetId(metrics), id);
  metrics["faces"] = {3, 6};
  EXPECT_NE(TestSetId(metrics), id);
  metrics.erase("faces");
  testing::ExpectError([&] { TestSetId(metrics); }, "malformed");
}

}  // namespace
}  // namespace daumier::ablation
