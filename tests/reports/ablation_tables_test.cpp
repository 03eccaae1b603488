#include "reports/ablation_tables.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

const std::vector<Metric> kColumns = {{.key = "p90", .title = "p90", .may_hide = true},
                                      {.key = "flips", .title = "flips", .may_hide = true}};

/// A row of table.json on one split with one seed.
Json MakeRow(const std::string& name, const std::string& split, double error) {
  return {{"name", name},
          {"split", split},
          {"baseline", false},
          {"paper", nullptr},
          {"unit", "mm"},
          {"error", error},
          {"error_low", error - 1},
          {"error_high", error + 1},
          {"seeds", {1, 2}},
          {"difference_to", nullptr},
          {"difference", nullptr},
          {"difference_low", nullptr},
          {"difference_high", nullptr},
          {"steps", 10},
          {"parameters", 7},
          {"train_seconds", 2.7},
          {"infer_ms", 2.0},
          {"shape_input", "none"},
          {"p90", 4.5}};
}

TEST(AblationTables, HaveARowARowAndASplitEach) {
  Json a = MakeRow("a", "person", 2), b = MakeRow("b", "person", 2.5);
  a["paper"] = 2.04;
  b["difference_to"] = "a";
  b["difference"] = b["difference_low"] = 0.5;
  b["difference_high"] = 0.625;
  b["steps"] = b["infer_ms"] = nullptr;
  const std::vector<ReportTable> tables = AblationTables({a, b, MakeRow("a", "random", 1)}, kColumns);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].title, "Split: person");
  EXPECT_EQ(tables[0].header,
            (std::vector<std::string>{"row", "shape input", "paper mm", "mm", "95 % interval", "against a", "p90",
                                      "steps", "parameters", "training s", "ms a face", "seeds"}));
  EXPECT_EQ(tables[0].rows[0], (std::vector<std::string>{"a", "none", "2.04", "2.000", "1.00 to 3.00", "-", "4.500",
                                                         "10", "7", "3", "2.00", "2"}));
  EXPECT_EQ(tables[0].rows[1], (std::vector<std::string>{"b", "none", "-", "2.500", "1.50 to 3.50",
                                                         "+0.50 (+0.50 to +0.62)", "4.500", "-", "7", "3", "-", "2"}));
  EXPECT_EQ(tables[1].title, "Split: random");
  EXPECT_EQ(tables[1].rows.size(), 1u);
}

TEST(AblationTables, OfValidationErrorsHaveNoIntervals) {
  Json row = MakeRow("a", "person", 2);
  row["measured_on"] = "validation";
  for (const char* key : {"error_low", "error_high", "infer_ms", "p90"}) row[key] = nullptr;
  row["validation_at_equal_time"] = 2.25;
  row.erase("shape_input");
  const ReportTable table = AblationTables(Json::array({row}), kColumns).at(0);
  EXPECT_EQ(table.header, (std::vector<std::string>{"row", "paper mm", "validation mm", "validation at equal time",
                                                    "steps", "parameters", "training s", "seeds"}));
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a", "-", "2.000", "2.250", "10", "7", "3", "2"}));
}

TEST(AblationTables, MarkdownHasATableASplitAndTheFootnote) {
  const std::string markdown = AblationMarkdown({MakeRow("a", "person", 2), MakeRow("a", "random", 1)}, kColumns);
  EXPECT_LT(markdown.find("## Split: person"), markdown.find("## Split: random"));
  EXPECT_NE(markdown.find("| a | none |"), std::string::npos);
  EXPECT_TRUE(markdown.ends_with(AblationFootnote() + "\n"));
}

TEST(AblationTables, RefuseRowsThatLackAKey) {
  Json row = MakeRow("a", "person", 2);
  row.erase("seeds");
  testing::ExpectError([&] { AblationTables(Json::array({row}), kColumns); }, "malformed");
}

}  // namespace
}  // namespace daumier::reports
