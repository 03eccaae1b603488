#include "systems/deform/metrics.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

/// A report of an earlier version, without flags and without mm_per_unit: a unit is 100 mm.
Json EarlierMetrics() {
  const auto row = [](const char* name, double error) {
    return Json{{"name", name},
                {"num_faces", 2},
                {"error", error},
                {"error_low", error / 2},
                {"error_high", 2 * error},
                {"p95", 3 * error},
                {"surface_sample_error", 4 * error},
                {"error_mm", 100 * error},
                {"percent_of_head_height", 40 * error},
                {"normal_error_degrees", 5.0},
                {"flipped_triangles", 1.0},
                {"self_intersections", nullptr},
                {"seconds", 0.5},
                {"face_errors", {error, error}}};
  };
  return {{"table", {row("network", 0.02), row("linear model", 0.03)}},
          {"data_hash", {{"faces", "f"}}},
          {"faces", {3, 5}},
          {"groups", {0, 1}}};
}

TEST(DeformMetrics, ReportsOfEarlierVersionsAreReadInMm) {
  const reports::MetricTable table = ReadDeformMetrics(EarlierMetrics());
  ASSERT_EQ(table.rows.size(), 2u);
  const reports::MetricRow& row = table.rows[0];
  EXPECT_NEAR(row.error().mean, 2, 1e-12);
  EXPECT_NEAR(row.error().interval->low, 1, 1e-12);
  EXPECT_NEAR(row.error().interval->high, 4, 1e-12);
  EXPECT_NEAR(row.face_errors[1], 2, 1e-12);
  EXPECT_EQ(reports::ValueOf(table, row, "model_units"), 0.02);
  EXPECT_NEAR(*reports::ValueOf(table, row, "p95"), 6, 1e-12);
  EXPECT_NEAR(*reports::ValueOf(table, row, "surface_sample_error_mm"), 8, 1e-12);
  EXPECT_EQ(reports::ValueOf(table, row, "percent_of_head_height"), 0.8);
  EXPECT_EQ(reports::ValueOf(table, row, "seconds_a_face"), 0.5);
  EXPECT_EQ(reports::ValueOf(table, row, "self_intersections"), std::nullopt);
  EXPECT_FALSE(row.baseline);
  EXPECT_TRUE(table.rows[1].baseline);
  EXPECT_EQ(table.groups, (std::vector<int>{0, 1}));
}

TEST(DeformMetrics, AModelWithoutErrorIsReadToo) {
  Json metrics = EarlierMetrics();
  metrics["table"].erase(1);
  for (const char* key : {"error", "error_low", "error_high", "error_mm"}) metrics["table"][0][key] = 0.0;
  EXPECT_EQ(ReadDeformMetrics(metrics).rows[0].error().mean, 0);
  metrics["mm_per_unit"] = 10;
  EXPECT_NEAR(*reports::ValueOf(ReadDeformMetrics(metrics), ReadDeformMetrics(metrics).rows[0], "p95"), 0.6, 1e-12);
}

TEST(DeformMetrics, SummaryColumnsAreInTheTableInMm) {
  const reports::MetricTable table = ReadDeformMetrics(EarlierMetrics());
  EXPECT_EQ(DeformSummaryColumns().size(), 6u);
  for (const reports::Metric& column : DeformSummaryColumns())
    EXPECT_TRUE(reports::FindColumn(table.columns, column.key).has_value()) << column.key;
}

TEST(DeformMetrics, RefusesWhatIsMalformed) {
  testing::ExpectError([] { ReadDeformMetrics(Json::object()); }, "malformed");
}

TEST(ModelUnit, OfAHeadFrameIsAShareOfTheHead) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const ModelUnit unit = UnitOf(face, faces::HeadFrame(face, 2.1));
  EXPECT_NEAR(unit.head_height, 2.1, 1e-12);
  const double head_cm = face.neutral.col(1).maxCoeff() - face.neutral(face.annotation.landmarks[8], 1);
  EXPECT_NEAR(unit.mm * 2.1, head_cm * faces::MillimetresPerCm(face), 1e-9);
}

}  // namespace
}  // namespace daumier::deform
