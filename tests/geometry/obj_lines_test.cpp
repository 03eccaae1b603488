#include "geometry/obj_lines.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

/// The whole numbers behind `v` of each line.
std::vector<std::vector<int>> IndexRows(const std::string& text) {
  ObjLines line(text, "a.obj");
  std::vector<std::vector<int>> rows;
  while (line.Next()) {
    if (!line.Accept("v")) continue;
    rows.emplace_back();
    while (!line.AtEnd()) rows.back().push_back(line.ReadIndex("no index"));
  }
  return rows;
}

TEST(ObjLines, EndWithAnyLineEnd) {
  const std::vector<std::vector<int>> expected = {{1, 2}, {3}, {4}};
  for (const char* end : {"\n", "\r\n", "\r", "\r\r\n", "\n\n", "  \n", "\t\r\n"}) {
    const std::string text = std::string("v 1 2") + end + "# v 9" + end + "\t v\t3" + end + "v 4";
    EXPECT_EQ(IndexRows(text), expected) << end;
    EXPECT_EQ(IndexRows(text + end), expected) << end;
    EXPECT_EQ(IndexRows("\xEF\xBB\xBF" + text), expected) << end;
  }
  EXPECT_EQ(IndexRows("v 1 2\nv 3\rv 4\r\n"), expected) << "mixed";
}

TEST(ObjLines, ContinueBehindABackslash) {
  const std::vector<std::vector<int>> expected = {{1, 2, 3}, {4}};
  for (const char* text :
       {"v 1 2 \\\n3\nv 4\n", "v 1 \\\r\n 2 \\\r\n 3\r\nv 4", "v 1\\\r2\\\r3\rv 4\\", "v\\\n1 2 3\nv 4 \\\n"})
    EXPECT_EQ(IndexRows(text), expected) << text;
  for (const char* other : {"# C:\\\n", "mtllib C:\\\n", "usemtl a\\\n"})
    EXPECT_EQ(IndexRows(std::string(other) + "v 1 2 3\nv 4 # D:\\\n"), expected) << other;
}

TEST(ObjLines, MessagesCountEveryLineEnd) {
  const std::string text = "v 1 \\\n 2\n\nv x\n";
  ObjLines line(text, "a.obj");
  while (line.Next() && line.Accept("v") && !line.AtEnd() && line.Skip('1')) {
  }
  line.Next();
  ExpectError([&] { line.Check(false, "problem"); }, "a.obj:4: problem");
}

TEST(ObjLines, ReadNumbersToTheEndOfTheirWord) {
  const std::string text = "v +1.5 -2#comment\nv 1.#INF 0,5\n";
  ObjLines line(text, "a.obj");
  ASSERT_TRUE(line.Next() && line.Accept("v"));
  EXPECT_EQ(line.ReadNumber("no number"), 1.5);
  EXPECT_FALSE(line.AtEnd());
  EXPECT_EQ(line.ReadNumber("no number"), -2);
  EXPECT_TRUE(line.AtEnd());
  EXPECT_FALSE(line.IsOpen());
  ASSERT_TRUE(line.Next() && line.Accept("v"));
  EXPECT_GT(line.ReadNumber("no number"), 1e308);
  EXPECT_FALSE(line.AtEnd());
  ExpectError([&] { line.ReadNumber("no number"); }, "a.obj:2: no number (found '0,5', expected one such as -0.25)");
}

TEST(ObjLines, KeywordsAreWholeWords) {
  const std::string text = "vt 1\nf\nfo 2";
  ObjLines line(text, "a.obj");
  ASSERT_TRUE(line.Next());
  EXPECT_FALSE(line.Accept("v"));
  EXPECT_TRUE(line.Accept("vt"));
  ASSERT_TRUE(line.Next());
  EXPECT_FALSE(line.Accept("f"));
  ASSERT_TRUE(line.Next());
  EXPECT_FALSE(line.Accept("f"));
  EXPECT_TRUE(line.Accept("fo"));
  EXPECT_TRUE(line.IsOpen());
  EXPECT_EQ(line.ReadIndex("no index"), 2);
  EXPECT_TRUE(line.AtWordEnd());
  EXPECT_FALSE(line.Next());
}

TEST(ObjLines, RefuseUtf16) {
  for (const char* mark : {"\xFF\xFEv", "\xFE\xFFv"})
    ExpectError([&] { ObjLines(mark, "a.obj"); }, "a.obj: not an OBJ file (found text in UTF-16");
}

}  // namespace
}  // namespace daumier::geometry
