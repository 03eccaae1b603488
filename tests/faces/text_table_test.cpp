#include "faces/text_table.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using Cells = std::vector<std::string>;

std::vector<Cells> RowsOf(std::string_view text) {
  std::vector<Cells> rows;
  for (const auto& row : ReadTextTable(text, "a.txt").rows) rows.push_back(row.cells);
  return rows;
}

TEST(TextTable, LinesOfAllSystems) {
  const std::vector<Cells> expected = {{"1", "2"}, {"3", "4"}};
  for (const char* text : {"1 2\n3 4\n", "1 2\r\n3 4\r\n", "1 2\r3 4", "\xEF\xBB\xBF 1\t 2 \n\n  3 4"})
    EXPECT_EQ(RowsOf(text), expected) << text;
  EXPECT_EQ(ReadTextTable("1\n\n2\n", "a").rows[1].line, 3);
}

TEST(TextTable, SignsBetweenCells) {
  EXPECT_EQ(RowsOf("a,1, 2\nb,,4\n"), (std::vector<Cells>{{"a", "1", "2"}, {"b", "", "4"}}));
  EXPECT_EQ(RowsOf("a;1;2\nb;;4\n"), (std::vector<Cells>{{"a", "1", "2"}, {"b", "", "4"}}));
  EXPECT_EQ(RowsOf("left eye\t1\t2\nb\t\t4\n"), (std::vector<Cells>{{"left eye", "1", "2"}, {"b", "", "4"}}));
  EXPECT_EQ(RowsOf("\"eye, left\",1,2\nnose,3,4\n"), (std::vector<Cells>{{"eye, left", "1", "2"}, {"nose", "3", "4"}}));
  EXPECT_EQ(RowsOf(";1;2\nb;3;4\n"), (std::vector<Cells>{{"", "1", "2"}, {"b", "3", "4"}}));
}

TEST(TextTable, CommentsAndHeaders) {
  const TextTable table = ReadTextTable("version: 1\nn_points: 2\n{\n1 2  # nose\n3 4 // chin\n}\n; end\n", "a");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].cells, (Cells{"1", "2"}));
  EXPECT_EQ(table.rows[1].cells, (Cells{"3", "4"}));
  EXPECT_EQ(table.remarks, (Cells{"version: 1", "n_points: 2", "end"}));
  EXPECT_EQ(RowsOf("Point #1,1,2\nPoint #2,3,4 # nose\n")[0][0], "Point #1");
  EXPECT_EQ(RowsOf("Point #1,1,2\nPoint #2,3,4 # nose\n")[1][2], "4");
}

TEST(TextTable, RefusesWhatIsNoText) {
  ExpectError([] { RowsOf("1,5 2,5 3,5\n1,5 2,5 3,5\n"); }, "line 1: '1,5' has a decimal comma");
  ExpectError([] { RowsOf("1;2\n1,5;2,5\n"); }, "line 2: '1,5' has a decimal comma");
  ExpectError([] { RowsOf("1,5\t2,5\n"); }, "'1,5' has a decimal comma");
  ExpectError([] { RowsOf(std::string_view("1\0 2", 4)); }, "a.txt: is binary");
  ExpectError(
      [] {
        RowsOf(
            "\xFF\xFE"
            "1");
      },
      "UTF-16");
  EXPECT_EQ(RowsOf("1,2 , 3\n4, 5,6\n"), (std::vector<Cells>{{"1", "2", "3"}, {"4", "5", "6"}}));
}

}  // namespace
}  // namespace daumier::faces
