#include "rig/print_base.h"

#include "geometry/closed_surface.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::rig {
namespace {

using geometry::TriangleMesh;

/// A ball of radius 5 without what lies below y = -3, whose rim is at several heights.
TriangleMesh OpenBall() {
  TriangleMesh ball = testing::Sphere(5, 4);
  std::vector<int> rows;
  for (int f = 0; f < ball.triangles.rows(); ++f)
    if (testing::MiddleOf(ball, ball.triangles.row(f), 1) > -3) rows.push_back(f);
  ball.triangles = ball.triangles(rows, Eigen::all).eval();
  return geometry::ConnectedParts(ball).front();
}

std::vector<std::vector<int>> LoopsOf(const TriangleMesh& mesh) {
  return geometry::BoundaryLoops(mesh.triangles, int(mesh.vertices.rows()));
}

double AreaAtHeight(const TriangleMesh& mesh, double level) {
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const bool is_there = std::ranges::all_of(std::array{t[0], t[1], t[2]},
                                              [&](int v) { return std::abs(mesh.vertices(v, 1) - level) < 1e-9; });
    if (!is_there) continue;
    const geometry::Vector3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
    const geometry::Vector3 normal = 0.5 * (b - a).cross(c - a);
    EXPECT_LE(normal.y(), 0) << "bases look down";
    sum -= normal.y();
  }
  return sum;
}

TEST(PrintBase, AnOpeningIsExtendedDownAndClosedFlat) {
  TriangleMesh ball = OpenBall();
  const auto loops = LoopsOf(ball);
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_EQ(OpeningTowards(ball, loops, -geometry::Vector3::UnitY()), 0u);
  EXPECT_FALSE(OpeningTowards(ball, loops, geometry::Vector3::UnitY()));
  EXPECT_FALSE(OpeningTowards(ball, loops, geometry::Vector3::UnitX()));
  EXPECT_EQ(AddFlatBase(loops[0], -6, ball), PrintBase::kOpening);
  EXPECT_TRUE(geometry::IsClosed(ball.triangles));
  EXPECT_EQ(geometry::EulerCharacteristic(ball.triangles), 2);
  EXPECT_EQ(ball.vertices.col(1).minCoeff(), -6);
  const double base = AreaAtHeight(ball, -6);
  EXPECT_NEAR(base, 3.14159 * 16, 4) << "a circle of radius 4";
  const double cap = 3.14159 * 2 * 2 * (15 - 2) / 3;  // Of the ball, below y = -3: pi h^2 (3 r - h) / 3.
  EXPECT_NEAR(geometry::EnclosedVolume(ball), 4.0 / 3 * 3.14159 * 125 - cap + base * 3, 15);
}

TEST(PrintBase, TheCapOfAClosedNeckIsReplaced) {
  TriangleMesh ball = testing::Sphere(5, 4);
  ball.vertices.col(1) = ball.vertices.col(1).cwiseMax(-3);
  EXPECT_EQ(AddFlatBase({}, -6, ball), PrintBase::kCap);
  EXPECT_TRUE(geometry::IsClosed(ball.triangles));
  EXPECT_EQ(geometry::EulerCharacteristic(ball.triangles), 2);
  EXPECT_NEAR(AreaAtHeight(ball, -6), 3.14159 * 16, 4);
}

TEST(PrintBase, WithoutACapTheLowestPartIsCutOff) {
  TriangleMesh wedge{geometry::Points(4, 3), geometry::Triangles(4, 3)};  // On a point.
  wedge.vertices << 0, 0, 0, 1, 9, 0, -1, 9, 1, -1, 9, -1;
  wedge.triangles << 0, 3, 1, 0, 2, 3, 0, 1, 2, 1, 3, 2;
  ASSERT_TRUE(geometry::IsClosed(wedge.triangles));
  ASSERT_GT(geometry::EnclosedVolume(wedge), 0);
  const double volume = geometry::EnclosedVolume(wedge);
  EXPECT_EQ(AddFlatBase({}, -6, wedge), PrintBase::kCut);
  EXPECT_TRUE(geometry::IsClosed(wedge.triangles));
  EXPECT_NEAR(wedge.vertices.col(1).minCoeff(), 0.09, 1e-9);
  EXPECT_NEAR(geometry::EnclosedVolume(wedge), volume, 0.02 * volume);
}

}  // namespace
}  // namespace daumier::rig
