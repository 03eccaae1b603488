#include "geometry/flips.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(FlippedTriangles, AreThoseThatTurnOver) {
  const TriangleMesh sheet = testing::FlatSheet(3);
  Points after = sheet.vertices;
  EXPECT_EQ(CountFlippedTriangles(sheet.vertices, after, sheet.triangles), 0);
  after.row(0) << 0.9, 0.9, 0;  // Both triangles of the first square fold over their far edges.
  EXPECT_EQ(FlippedTriangles(sheet.vertices, after, sheet.triangles), (std::vector<int>{0, 1}));
  EXPECT_EQ(FlippedTriangles(sheet.vertices, after, sheet.triangles, {0, 1, 5}), (std::vector<int>{0}));
  EXPECT_EQ(CountFlippedTriangles(sheet.vertices, after, sheet.triangles, {5, 6, 7}), 0);
  testing::ExpectError([&] { CountFlippedTriangles(sheet.vertices, after.topRows(2), sheet.triangles); }, "2 after");
}

TEST(FlippedTriangles, CountLostArea) {
  const TriangleMesh mesh = testing::EquilateralTriangle();
  EXPECT_EQ(CountFlippedTriangles(mesh.vertices, Points::Zero(3, 3), mesh.triangles), 1);
}

}  // namespace
}  // namespace daumier::geometry
