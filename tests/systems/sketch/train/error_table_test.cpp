#include "systems/sketch/train/error_table.h"

#include "core/error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

ErrorRow TwoFaces() {
  return MakeErrorRow("network", std::vector<double>{1, 3}, std::vector<double>{100, 60}, std::vector<int>{4, 4}, 1);
}

TEST(ErrorRow, HoldsMeanPercentilesAndTheShareOfTheEyeDistance) {
  const ErrorRow row = TwoFaces();
  EXPECT_DOUBLE_EQ(row.error_mm, 2);
  EXPECT_DOUBLE_EQ(row.p50_mm, 2);
  EXPECT_DOUBLE_EQ(row.p90_mm, 2.8);
  EXPECT_DOUBLE_EQ(row.interocular_share, (0.01 + 0.05) / 2);
  EXPECT_DOUBLE_EQ(row.interval_mm.low, 2);
  EXPECT_THROW(MakeErrorRow("x", std::vector<double>{1}, std::vector<double>{}, std::vector<int>{1}, 1), Error);
}

TEST(Table, TextIsAligned) {
  ErrorRow other = TwoFaces();
  other.name = "a much longer name";
  other.shape_input = "given";
  EXPECT_EQ(TableText({TwoFaces(), other}),
            "predictor           shape input     mm   95 % interval  median    p90    p99  of eye distance\n"
            "network                    none  2.000  2.000 to 2.000   2.000  2.800  2.980           3.00 %\n"
            "a much longer name        given  2.000  2.000 to 2.000   2.000  2.800  2.980           3.00 %\n");
}

TEST(Table, MarkdownHasAHeadAndARule) {
  EXPECT_EQ(TableMarkdown({TwoFaces()}),
            "| predictor | shape input | mm | 95 % interval | median | p90 | p99 | of eye distance |\n"
            "|---|---:|---:|---:|---:|---:|---:|---:|\n"
            "| network | none | 2.000 | 2.000 to 2.000 | 2.000 | 2.800 | 2.980 | 3.00 % |\n");
}

TEST(Table, JsonHasAnObjectARow) {
  const Json list = TableJson({TwoFaces()});
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["name"], "network");
  EXPECT_EQ(list[0]["shape_input"], "none");
  EXPECT_EQ(list[0]["error"], 2.0);
  EXPECT_EQ(list[0]["error_low"], 2.0);
  EXPECT_EQ(list[0]["error_high"], 2.0);
  EXPECT_EQ(list[0]["p90"], 2.8);
  EXPECT_EQ(list[0]["face_errors_mm"], Json::array({1.0, 3.0}));
}

TEST(Table, FromJsonUndoesJson) {
  const std::vector<ErrorRow> rows = {TwoFaces(), TwoFaces()};
  EXPECT_EQ(TableText(TableFromJson(Json::parse(TableJson(rows).dump()))), TableText(rows));
  EXPECT_THROW(TableFromJson(Json::parse(R"([{"name": "network"}])")), Error);
}

}  // namespace
}  // namespace daumier::sketch
