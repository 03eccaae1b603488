#include "systems/portrait/alignment_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::portrait {
namespace {

TEST(AlignmentTables, ShowPixelsAndShares) {
  AlignmentErrors errors;
  errors.used_px.fill(2);
  errors.alternate_px.fill(3);
  errors.left_out_px.fill(5);
  errors.interocular_px = 50;
  errors.error_mm = 4;
  errors.flips = 1;
  AlignmentErrors other = errors;
  other.used_px.fill(4);
  other.flips = 0;
  const std::vector<AlignmentRow> rows = {{AlignmentMethod::kFine, {errors, other}}};
  const std::vector<std::string> landmarks = LandmarkTable(rows).rows.at(0);
  EXPECT_EQ(landmarks.front(), "fine, uniform");
  EXPECT_EQ(landmarks[1], "3.00 (6.0 %)");
  EXPECT_EQ(landmarks[7], "3.00 (6.0 %)");
  EXPECT_EQ(landmarks.back(), "37.44");
  EXPECT_EQ(LeftOutTable(rows).rows.at(0)[1], "10.0 %");
  const std::vector<std::string> shape = ShapeTable(rows, {0, 1}).rows.at(0);
  EXPECT_EQ(shape[1], "4.00 (4.00 to 4.00)");
  EXPECT_EQ(shape[3], "0.5");
  EXPECT_EQ(shape[4], "1 of 2");
  const Json json = AlignmentJson(rows);
  EXPECT_NEAR(json.at(0).at("eyes").get<double>(), 0.06, 1e-12);
  EXPECT_NEAR(json.at(0).at("held_out").get<double>(), 0.06, 1e-12);
}

}  // namespace
}  // namespace daumier::portrait
