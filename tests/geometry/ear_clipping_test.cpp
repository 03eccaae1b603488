#include "geometry/ear_clipping.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::geometry {
namespace {

FlatPolygon Corners(std::initializer_list<Eigen::RowVector2d> corners) {
  FlatPolygon polygon(std::ssize(corners), 2);
  Eigen::Index i = 0;
  for (const Eigen::RowVector2d& corner : corners) polygon.row(i++) = corner;
  return polygon;
}

/// The sum of the areas of its triangles, each of which has to run counter-clockwise.
double AreaOfTriangles(const FlatPolygon& polygon, const Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles.rowwise()) {
    FlatPolygon one(3, 2);
    one << polygon.row(t[0]), polygon.row(t[1]), polygon.row(t[2]);
    EXPECT_GE(SignedArea(one), 0);
    sum += SignedArea(one);
  }
  return sum;
}

TEST(EarClipping, CutsPolygonsThatAreNotConvex) {
  const FlatPolygon angle = Corners({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_DOUBLE_EQ(SignedArea(angle), 3);
  EXPECT_TRUE(IsSimple(angle));
  const Triangles triangles = ClipEars(angle);
  EXPECT_EQ(triangles.rows(), 4);
  EXPECT_DOUBLE_EQ(AreaOfTriangles(angle, triangles), 3);
  FlatPolygon star(40, 2);
  for (int i = 0; i < 40; ++i) {
    const double angle_of = 2 * std::numbers::pi * i / 40, radius = i % 2 == 0 ? 1 : 0.3;
    star.row(i) << radius * std::cos(angle_of), radius * std::sin(angle_of);
  }
  EXPECT_NEAR(AreaOfTriangles(star, ClipEars(star)), SignedArea(star), 1e-12);
}

TEST(EarClipping, KnowsPolygonsThatCrossOrTouchThemselves) {
  EXPECT_FALSE(IsSimple(Corners({{0, 0}, {1, 1}, {1, 0}, {0, 1}})));
  EXPECT_FALSE(IsSimple(Corners({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}))) << "a corner on a side";
  EXPECT_FALSE(IsSimple(Corners({{0, 0}, {1, 1}})));
  EXPECT_TRUE(IsSimple(Corners({{0, 0}, {1, 0}, {0, 1}})));
}

TEST(EarClipping, RefusesPolygonsWithoutEars) {
  testing::ExpectError([] { ClipEars(Corners({{0, 0}, {1, 1}})); }, "2 corners, expected 3 or more");
  testing::ExpectError([] { ClipEars(Corners({{0, 0}, {0, 1}, {1, 1}, {1, 0}})); }, "crosses itself");
}

}  // namespace
}  // namespace daumier::geometry
