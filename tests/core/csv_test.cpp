#include "core/csv.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

using testing::ExpectError;

TEST(Csv, RowsAndCellsAreThoseReadByHand) {
  const std::vector<CsvRow> rows = ParseCsv("a,b\n\n1,\r\n\" x, y\"\"z\",\"two\nlines\"\nend", "t.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].cells, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(rows[1].cells, (std::vector<std::string>{"1", ""}));
  EXPECT_EQ(rows[1].line, 3);
  EXPECT_EQ(rows[2].cells, (std::vector<std::string>{" x, y\"z", "two\nlines"}));
  EXPECT_EQ(rows[3].line, 6) << "after the line end within quotes";
  EXPECT_EQ(rows[3].cells, (std::vector<std::string>{"end"}));
  EXPECT_TRUE(ParseCsv("", "t.csv").empty());
  EXPECT_EQ(ParseCsv("\xEF\xBB\xBFname\n", "t.csv").front().cells.front(), "name") << "as spreadsheets write it";
}

TEST(Csv, AnyTextComesBackFromItsCell) {
  constexpr std::string_view kSigns = "a,\"\n\r; #";
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    std::string first, second;
    for (uint64_t k = rng.Below(6); k > 0; --k) first += kSigns[rng.Below(kSigns.size())];
    for (uint64_t k = rng.Below(6); k > 0; --k) second += kSigns[rng.Below(kSigns.size())];
    const std::vector<CsvRow> rows = ParseCsv(CsvCell(first) + ',' + CsvCell(second) + '\n', "t.csv");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].cells, (std::vector<std::string>{first, second}));
  }
}

TEST(Csv, WrongTextIsRefusedByLine) {
  ExpectError([] { ParseCsv("a\n1,\"b\n\n", "t.csv"); }, "t.csv:2: a quote is not closed");
  const CsvRow row{7, {"1.5", "one", "inf", ""}};
  EXPECT_EQ(CsvNumber(row, 0, "t.csv"), 1.5);
  ExpectError([&] { CsvNumber(row, 1, "t.csv"); }, "t.csv:7: cell 2 is 'one', expected a number");
  ExpectError([&] { CsvNumber(row, 2, "t.csv"); }, "t.csv:7: cell 3 is 'inf'");
  ExpectError([&] { CsvNumber(row, 3, "t.csv"); }, "t.csv:7: cell 4 is ''");
  ExpectError([&] { CsvNumber(row, 4, "t.csv"); }, "t.csv:7: 4 cells, expected 5 or more");
}

}  // namespace
}  // namespace daumier
