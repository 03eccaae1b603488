#include "faces/marked_forms.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Vector3;
using testing::ExpectError;

TEST(MarkedForms, PrintedArraysBecomeRows) {
  for (const char* text : {"[[1. 2. 3.]\n [4. 5. 6.]]", "array([[1., 2., 3.],\n       [4., 5., 6.]], dtype=float32)",
                           "[1., 2., 3.]\n[4., 5., 6.]\n", "(1. 2. 3.)\n(4. 5. 6.)", "[(1., 2., 3.), (4., 5., 6.)]",
                           "tensor([[1., 2., 3.],\r\n        [4., 5., 6.]])", "[[1.,\n2., 3.], [4., 5., 6.],]"}) {
    const std::string rows = RowsOfPrintedArray(text).value_or("");
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 2) << text;
    EXPECT_EQ(rows.find("[") + rows.find("("), 2 * std::string::npos) << rows;
    EXPECT_LT(rows.find("3."), rows.find('\n')) << rows;
    EXPECT_GT(rows.find("4."), rows.find('\n')) << rows;
  }
  EXPECT_EQ(RowsOfPrintedArray("[12 13\n 14]"), "12\n13\n\n14\n");
}

TEST(MarkedForms, OtherTextIsNoPrintedArray) {
  for (const char* text : {"", "[[1, 2, 3], [4, 5, 6]]", "[[1. 2.", "[1. 2.)", "[1.]]", "a [1. 2.]", "1 2 3", "array("})
    EXPECT_FALSE(RowsOfPrintedArray(text)) << text;
}

TEST(MarkedForms, TpsOfOneSpecimen) {
  EXPECT_EQ(RowsOfTps("LM3=2\n1 2 3\n4 5 6\nID=a\nSCALE=1.0\n", "a.tps"), "\n1 2 3\n4 5 6\n\n\n");
  EXPECT_EQ(RowsOfTps("lm = 1\r\n1 2\r\nCURVES=1\r\nPOINTS=1\r\n8 9\r\n", "a.tps"), "\n1 2\r\n\n\n\n");
  EXPECT_FALSE(RowsOfTps("1 2 3\nLM=2\n", "a.tps"));
  EXPECT_FALSE(RowsOfTps("", "a.tps"));
  ExpectError([] { RowsOfTps("LM=3\n1 2\n3 4\nID=a\n", "a.tps"); }, "a.tps: states 3 landmarks, but 2 rows follow");
  ExpectError([] { RowsOfTps("LM=1\n1 2\nID=a\nLM=1\n1 2\n", "a.tps"); }, "line 4: a second specimen begins");
  ExpectError([] { RowsOfTps("LM=x\n", "a.tps"); }, "line 1: 'LM=X' is no number of landmarks");
}

TEST(MarkedForms, VerticesOfPly) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 2\n";
  const MarkedPoints marked = ParseMarkedPly(
      head +
          "property float z\nproperty uchar red\nproperty float x\nproperty float y\nend_header\n3 9 1 2\nnan 9 4 5\n",
      "a.ply");
  ASSERT_EQ(marked.points.size(), 2u);
  EXPECT_EQ(marked.points[0], Vector3(1, 2, 3));
  EXPECT_FALSE(marked.points[1]);
  ExpectError([&] { ParseMarkedPly(head + "property float x\nend_header\n1\n2\n", "a.ply"); }, "without x, y and z");
  ExpectError(
      [] {
        ParseMarkedPly(
            "ply\nformat ascii 1.0\nelement vertex 5000\nproperty char x\nend_header\n" + std::string(10000, '1'),
            "a.ply");
      },
      "a.ply");
}

}  // namespace
}  // namespace daumier::faces
