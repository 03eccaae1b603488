#include "faces/marked_rows.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Vector3;
using testing::ExpectError;

MarkedPoints Rows(std::string_view text) {
  return ParseMarkedRows(text, "a.txt");
}

TEST(MarkedRows, TheSamePointsInEveryWriting) {
  for (const char* text : {
           "1 2 3.5\n4 5 6\n7 8 9.5\n",                                          // Plain.
           "3\n1 2 3.5\n4 5 6\n7 8 9.5\n",                                       // With a count,
           "3 3\n1 2 3.5\n4 5 6\n7 8 9.5\n",                                     // and with that of coordinates.
           "1,2,3.5\n4,5,6\n7,8,9.5\n",                                          // Commas,
           "1;2;3.5\r4;5;6\r7;8;9.5",                                            // semicolons,
           "1\t2\t3.5\n4\t5\t6\n7\t8\t9.5\n",                                    // tabulators.
           "1 1 2 3.5\n2 4 5 6\n3 7 8 9.5\n",                                    // Numbers from 1
           "0 1 2 3.5\n1 4 5 6\n2 7 8 9.5\n",                                    // and from 0.
           "nose 1 2 3.5\nchin 4 5 6\nbrow 7 8 9.5\n",                           // Names in front
           "1,2,3.5,nose\n4,5,6,chin\n7,8,9.5,brow\n",                           // or behind.
           "name,x,y,z\nnose,1,2,3.5\nchin,4,5,6\nbrow,7,8,9.5\n",               // A header
           "z (mm),y (mm),x (mm)\n3.5,2,1\n6,5,4\n9.5,8,7\n",                    // in another order.
           "id;Pos_X;Pos_Y;Pos_Z;note\n4;1;2;3.5;a\n9;4;5;6;b\n2;7;8;9.5;c\n",   // More columns.
           "version: 1\nn_points: 3\n{\n1 2 3.5\n4 5 6\n7 8 9.5\n}\n",           // iBUG.
           "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n"  // Slicer.
           "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
           "1,1,2,3.5,0,0,0,1,1,1,0,F-1,,\n2,4,5,6,0,0,0,1,1,1,0,F-2,,\n3,7,8,9.5,0,0,0,1,1,1,0,F-3,,\n",
       }) {
    const MarkedPoints marked = Rows(text);
    EXPECT_EQ(marked.dimension, 3) << text;
    ASSERT_EQ(marked.points.size(), 3u) << text;
    EXPECT_EQ(marked.points[0], Vector3(1, 2, 3.5)) << text;
    EXPECT_EQ(marked.points[1], Vector3(4, 5, 6)) << text;
    EXPECT_EQ(marked.points[2], Vector3(7, 8, 9.5)) << text;
  }
}

TEST(MarkedRows, PointsOfAPictureAndVertices) {
  const MarkedPoints picture = Rows("2\n117.25 152.8\n120.2 176.2\n");
  EXPECT_EQ(picture.dimension, 2);
  EXPECT_EQ(picture.points[1], Vector3(120.2, 176.2, 0));
  const MarkedPoints vertices = Rows("# chin\n12  # a\n-1\n5\n");
  EXPECT_EQ(vertices.dimension, 1);
  EXPECT_EQ(vertices.points[1], Vector3(-1, 0, 0));
  const MarkedPoints numbered = Rows("1 700\n2 5\n3 900\n");
  EXPECT_EQ(numbered.dimension, 1);
  EXPECT_EQ(numbered.points[2], Vector3(900, 0, 0));
  EXPECT_EQ(numbered.labels[2], "3");
  const MarkedPoints shuffled = Rows("2 7 8 9\n0 1 2 3\n1 4 5 6\n");  // OrderLandmarks puts them in order.
  EXPECT_EQ(shuffled.points[0], Vector3(7, 8, 9));
  EXPECT_EQ(shuffled.labels[0], "2");
  EXPECT_EQ(Rows("landmark,vertex_id\nnose,3\nchin,8\n").points[1], Vector3(8, 0, 0));
}

TEST(MarkedRows, AbsentPoints) {
  for (const char* text : {"1 2 3\nnan nan nan\n7 8 9\n", "1 2 3\n-\n7 8 9\n", "1,2,3\n,,\n7,8,9\n",
                           "a\t1\t2\t3\nb\t\t\t\nc\t7\t8\t9\n", "1 1 2 3\n2 - - -\n3 7 8 9\n", "1 1 2 3\n2\n3 7 8 9\n",
                           "1;2;3\nNA;NA;NA\n7;8;9\n", "x,y,z\n1,2,3\n4,,6\n7,8,9\n"}) {
    const MarkedPoints marked = Rows(text);
    ASSERT_EQ(marked.points.size(), 3u) << text;
    EXPECT_EQ(marked.dimension, 3) << text;
    EXPECT_FALSE(marked.points[1]) << text;
    EXPECT_EQ(marked.points[2], Vector3(7, 8, 9)) << text;
  }
}

TEST(MarkedRows, NumbersInAnyLayout) {
  EXPECT_EQ(Rows("1 2 3 4\n5 6\n").points.size(), 6u);
  EXPECT_EQ(Rows("1 2 3 4 5 6 7").dimension, 1);
}

TEST(MarkedRows, TheFrameOfSlicer) {
  EXPECT_EQ(Rows("# CoordinateSystem = LPS\n0,1,2,3,0,0,0,1,1,1,0,F-0,,\n").frame, PatientFrame::kLps);
  EXPECT_EQ(Rows("# CoordinateSystem = 0\n0,1,2,3,0,0,0,1,1,1,0,F-0,,\n").frame, PatientFrame::kRas);
  EXPECT_FALSE(Rows("1 2 3\n4 5 6\n").frame);
}

TEST(MarkedRows, RefusesWithTheLine) {
  ExpectError([] { Rows("1 2 3\n4 five 6\n7 8 9\n"); }, "a.txt: line 2: 'five' is not a number");
  ExpectError([] { Rows("nose\nchin\n"); }, "line 1: 'nose' is not a number");
  ExpectError([] { Rows("4\n1 2 3\n4 5 6\n"); }, "line 1: states 4 points, but 2 rows follow");
  ExpectError([] { Rows("n_points: 3\n{\n1 2\n4 5\n}\n"); }, "states n_points: 3, but 2 points follow");
  ExpectError([] { Rows("a 1 2 3\nb 4 5\nc 7 8 9\n"); }, "line 2: 3 cells, the other rows have 4");
  ExpectError([] { Rows("# nothing\n"); }, "holds no point");
  ExpectError([] { Rows("1e999 2 3\n4 5 6\n7 8 9\n"); }, "line 1: '1e999' is not a finite number");
  ExpectError([] { Rows("inf 0 0\ninf 1 0\n"); }, "line 1: 'inf' is not a finite number");
  ExpectError([] { Rows("# CoordinateSystem = LPS\na,1,2\nb,1,2\n"); }, "line 2: 3 cells, expected 4 or more");
}

}  // namespace
}  // namespace daumier::faces
