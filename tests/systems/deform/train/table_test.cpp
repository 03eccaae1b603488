#include "systems/deform/train/table.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

SurfaceErrors Errors(double mean) {
  return {.mean_vertex_error = mean,
          .p95_vertex_error = 2 * mean,
          .surface_sample_error = 3 * mean,
          .normal_error_degrees = 4 * mean,
          .flipped_triangles = 5 * mean};
}

TEST(DeformTable, ARowHoldsMeansOverFaces) {
  std::vector<SurfaceErrors> errors{Errors(1), Errors(2), Errors(6)};
  errors[0].self_intersections = 4;
  errors[1].self_intersections = 7;
  const DeformRow row = MakeDeformRow("network", errors, std::vector<int>{0, 0, 1}, 1);
  EXPECT_EQ(row.num_faces, 3);
  EXPECT_EQ(row.mean.mean_vertex_error, 3);
  EXPECT_EQ(row.mean.p95_vertex_error, 6);
  EXPECT_EQ(row.mean.surface_sample_error, 9);
  EXPECT_EQ(row.mean.normal_error_degrees, 12);
  EXPECT_EQ(row.mean.flipped_triangles, 15);
  EXPECT_EQ(row.mean.self_intersections, 5.5) << "of the faces on which they were counted";
  EXPECT_EQ(row.mean.seconds, std::nullopt);
  EXPECT_EQ(row.interval.low, 1.5) << "of two persons, both draws can be the first";
  EXPECT_EQ(row.interval.high, 6);
}

TEST(DeformTable, RefusesErrorsWithoutGroups) {
  testing::ExpectError([] { MakeDeformRow("network", {Errors(1)}, std::vector<int>{}, 1); }, "1 errors of 0 faces");
}

TEST(DeformTable, TellsMillimetresAndTheShareOfTheHead) {
  const ModelUnit unit{.mm = 110, .head_height = 2.1};
  const std::vector<DeformRow> rows{MakeDeformRow("network", {Errors(0.021)}, std::vector<int>{0}, 1)};
  const Json row = DeformTableJson(rows, unit).at(0);
  EXPECT_EQ(row.at("name"), "network");
  EXPECT_NEAR(row.at("error_mm").get<double>(), 2.31, 1e-12);
  EXPECT_NEAR(row.at("percent_of_head_height").get<double>(), 1, 1e-12);
  EXPECT_TRUE(row.at("seconds").is_null());
  const reports::ReportTable table = DeformReportTable(rows, unit);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].size(), table.header.size());
  EXPECT_EQ(table.rows[0][2], "0.0210");
  EXPECT_EQ(table.rows[0].back(), "-");
  EXPECT_NE(DeformTableMarkdown(rows, unit).find("| network | 1 | 0.0210 | 0.0210 to 0.0210 |"), std::string::npos);
}

TEST(DeformTable, AUnitOfAHeadFrameIsAShareOfTheHead) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const ModelUnit unit = UnitOf(face, faces::HeadFrame(face, 2.1));
  EXPECT_NEAR(unit.head_height, 2.1, 1e-12);
  const double head_cm = face.neutral.col(1).maxCoeff() - face.neutral(face.annotation.landmarks[8], 1);
  EXPECT_NEAR(unit.mm * 2.1, head_cm * faces::MillimetresPerCm(face), 1e-9);
}

}  // namespace
}  // namespace daumier::deform
