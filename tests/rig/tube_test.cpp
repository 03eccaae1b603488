#include "rig/tube.h"

#include "geometry/topology.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr Tube kTube{4, 6};

/// Along z, sides clockwise around it.
geometry::Points Cylinder() {
  geometry::Points points(kTube.num_vertices(), 3);
  for (int column = 0; column < 4; ++column)
    for (int side = 0; side < 6; ++side) {
      const double angle = -std::numbers::pi * side / 3;
      points.row(kTube.vertex(column, side)) << std::cos(angle), std::sin(angle), column;
    }
  points.row(kTube.pole(false)) << 0, 0, 0;
  points.row(kTube.pole(true)) << 0, 0, 3;
  return points;
}

TEST(Tube, IsClosedAndFacesOutwards) {
  const ChartPiece piece = TubeChart(kTube, {0, 0.2, 0.6, 1}, 0.5, TextureChart::kTongue, 0, 1);
  ASSERT_EQ(piece.triangles.rows(), kTube.num_triangles());
  EXPECT_NO_THROW(geometry::CheckManifold(piece.triangles, kTube.num_vertices()));
  EXPECT_TRUE(geometry::BoundaryLoops(piece.triangles, kTube.num_vertices()).empty());
  EXPECT_EQ(geometry::EulerCharacteristic(piece.triangles), 2);
  const geometry::Points points = Cylinder();
  double volume = 0;
  for (const auto& t : piece.triangles.rowwise()) {
    const geometry::Vector3 a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
    volume += a.dot(b.cross(c)) / 6;
  }
  EXPECT_NEAR(volume, 3 * 6 * std::sin(std::numbers::pi / 3) / 2, 1e-9) << "a prism over a hexagon";
}

TEST(Tube, LiesFlatWithoutOverlaps) {
  const ChartPiece piece = TubeChart(kTube, {0, 0.2, 0.6, 1}, 0.5, TextureChart::kTongue, 10, 1);
  EXPECT_EQ(piece.triangles.minCoeff(), 10);
  const TextureSpace space = AssembleCharts({piece});
  EXPECT_EQ(NumOverlappingTexels(space, 256), 0);
  for (const auto& t : space.uv_triangles.rowwise()) {
    const Eigen::RowVector2d a = space.uv.row(t[0]), b = space.uv.row(t[1]) - a, c = space.uv.row(t[2]) - a;
    EXPECT_GT(b.x() * c.y() - b.y() * c.x(), 0);
  }
}

TEST(Tube, NamesTheSideOfEachTriangle) {
  const ChartPiece piece = TubeChart(kTube, {0, 0.2, 0.6, 1}, 0.5, TextureChart::kTongue, 0, 1);
  const std::vector<int> sides = kTube.Sides();
  ASSERT_EQ(int(sides.size()), kTube.num_triangles());
  for (int t = 0; t < kTube.num_triangles(); ++t)
    for (const int v : piece.triangles.row(t))
      if (v < kTube.pole(false)) EXPECT_TRUE(v % 6 == sides[size_t(t)] || v % 6 == (sides[size_t(t)] + 1) % 6);
}

TEST(Tube, RefusesAnotherNumberOfColumns) {
  testing::ExpectError(
      [] {
        TubeChart(kTube, {0, 1}, 0.5, TextureChart::kTongue, 0, 1);
      },
      "2 places were given for 4 columns");
}

}  // namespace
}  // namespace daumier::rig
