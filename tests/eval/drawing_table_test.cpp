#include "eval/drawing_table.h"

#include <gtest/gtest.h>

namespace daumier::eval {
namespace {

using faces::FacePoint;

/// Errors of a mouth corner and of the chin.
PointErrors TwoErrors(double mouth, double chin) {
  PointErrors errors;
  errors[size_t(FacePoint::kMouthLeft)] = mouth;
  errors[size_t(FacePoint::kChin)] = chin;
  return errors;
}

std::vector<DrawingScore> ThreeScores() {
  DrawingScore first{.name = "a", .group = "pictures"};
  first.errors = TwoErrors(0.02, 0.06);
  first.aligned = TwoErrors(0.01, 0.01);
  first.mean_face = TwoErrors(0.05, 0.05);
  first.mouth_is_right = true;
  first.is_recognised = true;
  first.states = {.lip_gap_mm = 2, .lid_gap_mm = 8};
  DrawingScore second = first;
  second.name = "b";
  second.is_predicted = false;
  second.errors = TwoErrors(0.1, 0.2);
  second.mouth_is_right = false;
  second.eyes_are_right = true;
  second.is_recognised = false;
  second.states.lip_gap_mm = -2;
  DrawingScore doodle = first;
  doodle.name = "q";
  doodle.group = "doodles";
  doodle.is_recognised = {};
  return {first, second, doodle};
}

TEST(GroupScores, AveragesDrawingsOfAGroup) {
  const auto groups = GroupScores(ThreeScores());
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "pictures");
  EXPECT_EQ(groups[0].num_drawings, 2);
  EXPECT_EQ(groups[0].num_predicted, 1);
  EXPECT_NEAR(groups[0].nme, (4.0 + 15.0) / 2, 1e-9);
  EXPECT_NEAR(groups[0].median_nme, (4.0 + 15.0) / 2, 1e-9);
  EXPECT_NEAR(groups[0].mean_face_nme, 5, 1e-9);
  EXPECT_NEAR(groups[0].aligned_nme, 1, 1e-9);
  EXPECT_EQ(groups[0].num_better, 1);
  EXPECT_NEAR(groups[0].parts[3].value(), (2.0 + 10.0) / 2, 1e-9);
  EXPECT_NEAR(groups[0].parts[4].value(), (6.0 + 20.0) / 2, 1e-9);
  EXPECT_FALSE(groups[0].parts[0].has_value());
  EXPECT_EQ(groups[0].mouth_right, 1);
  EXPECT_EQ(groups[0].mouth_known, 2);
  EXPECT_EQ(groups[0].eyes_right, 1);
  EXPECT_EQ(groups[0].eyes_known, 1);
  EXPECT_EQ(groups[0].num_crossed_lips, 1);
  EXPECT_EQ(groups[0].num_recognised, 1);
  EXPECT_EQ(groups[1].num_drawings, 1);
}

TEST(DrawingTable, NamesTheMeanFaceAndWhatIsUnknown) {
  const auto table = DrawingTable(ThreeScores());
  ASSERT_EQ(table.rows.size(), 3U);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
  EXPECT_EQ(table.rows[0][0], "a");
  EXPECT_EQ(table.rows[0][1], "4.0");
  EXPECT_EQ(table.rows[1][0], "b (mean face)");
  EXPECT_EQ(table.rows[1].back(), "no");
  EXPECT_EQ(table.rows[2].back(), "-");
}

TEST(DrawingGroupTable, HasTheMeanFaceUnderEachGroup) {
  const auto table = DrawingGroupTable(GroupScores(ThreeScores()));
  ASSERT_EQ(table.rows.size(), 4U);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
  EXPECT_EQ(table.rows[0][2], "9.5");
  EXPECT_EQ(table.rows[0][5], "1/2");
  EXPECT_EQ(table.rows[1][2], "5.0");
  EXPECT_EQ(table.rows[1][9], "5.0") << "mouth";
}

TEST(DrawingScoresToJson, HoldsBothTables) {
  const Json json = DrawingScoresToJson(ThreeScores());
  EXPECT_EQ(json.at("groups").size(), 2U);
  EXPECT_NEAR(json.at("groups")[0].at("nme").get<double>(), 9.5, 1e-9);
  EXPECT_TRUE(json.at("groups")[0].at("parts").at("eyes").is_null());
  EXPECT_EQ(json.at("drawings")[1].at("predicted"), false);
  EXPECT_EQ(json.at("drawings")[1].at("lips_cross"), true);
  EXPECT_TRUE(json.at("drawings")[2].at("recognised").is_null());
}

}  // namespace
}  // namespace daumier::eval
