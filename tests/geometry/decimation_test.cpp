#include "geometry/decimation.h"

#include "geometry/closed_surface.h"
#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace daumier::geometry {
namespace {

const Eigen::MatrixXf kNoOffsets;

TriangleMesh SurfaceOf(const TriangleMesh& mesh, const DecimatedSurface& decimated) {
  return {mesh.vertices, decimated.triangles};
}

std::set<int> UsedVertices(const Triangles& triangles) {
  return {triangles.data(), triangles.data() + triangles.size()};
}

/// The unit cube, each side n x n squares.
TriangleMesh CubeOfSquares(int n) {
  std::vector<TriangleMesh> sides;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_far : {false, true}) {
      TriangleMesh side = testing::FlatSheet(n);
      const Points flat = side.vertices;
      side.vertices.col(axis).setConstant(is_far ? 1 : 0);
      side.vertices.col((axis + 1) % 3) = flat.col(0);
      side.vertices.col((axis + 2) % 3) = flat.col(1);
      if (!is_far) side.triangles.col(1).swap(side.triangles.col(2));
      sides.push_back(side);
    }
  }
  return Joined(sides);  // Vertices of edges occur two or three times.
}

TEST(Decimation, APlaneIsItsFourCorners) {
  const TriangleMesh sheet = testing::FlatSheet(8);
  const DecimatedSurface decimated = Decimate({sheet, kNoOffsets}, 2);
  EXPECT_TRUE(decimated.is_reached);
  ASSERT_EQ(decimated.triangles.rows(), 2);
  EXPECT_EQ(UsedVertices(decimated.triangles), (std::set<int>{0, 8, 72, 80}));
  EXPECT_NEAR(TriangleAreas(SurfaceOf(sheet, decimated)).sum(), 1, 1e-12);
}

TEST(Decimation, ACubeOfSplitSidesIsItsTwelveTriangles) {
  const TriangleMesh cube = CubeOfSquares(5);
  const DecimatedSurface decimated = Decimate({cube, kNoOffsets}, 12);
  ASSERT_EQ(decimated.triangles.rows(), 12);
  EXPECT_TRUE(IsClosed(decimated.triangles)) << "vertices at one place are one";
  EXPECT_NEAR(EnclosedVolume(SurfaceOf(cube, decimated)), 1, 1e-12);
}

TEST(Decimation, AClosedSurfaceStaysClosedWithItsGenusAndTurnsNoTriangle) {
  const TriangleMesh sphere = testing::Sphere(1, 4), torus = testing::Torus(2, 0.5, 40, 20);
  const DecimatedSurface ball = Decimate({sphere, kNoOffsets}, 200), ring = Decimate({torus, kNoOffsets}, 200);
  EXPECT_LE(ball.triangles.rows(), 200);
  EXPECT_GE(ball.triangles.rows(), 199);
  EXPECT_TRUE(IsClosed(ball.triangles));
  EXPECT_EQ(EulerCharacteristic(ball.triangles), 2);
  EXPECT_TRUE(IsClosed(ring.triangles));
  EXPECT_EQ(EulerCharacteristic(ring.triangles), 0);
  const TriangleMesh surface = SurfaceOf(sphere, ball);
  const Points normals = TriangleNormals(surface);
  for (Eigen::Index f = 0; f < normals.rows(); ++f) {
    const Eigen::RowVector3d middle =
        (surface.vertices.row(surface.triangles(f, 0)) + surface.vertices.row(surface.triangles(f, 1)) +
         surface.vertices.row(surface.triangles(f, 2))) /
        3;
    EXPECT_GT(normals.row(f).dot(middle.normalized()), 0.8);
  }
  EXPECT_GT(EnclosedVolume(surface), 0.92 * EnclosedVolume(sphere));
}

TEST(Decimation, KeepsAFoldThatOnlyAPoseHas) {
  const TriangleMesh sheet = testing::FlatSheet(8);
  Eigen::MatrixXf offsets = Eigen::MatrixXf::Zero(3 * sheet.vertices.rows(), 1);
  for (Eigen::Index v = 0; v < sheet.vertices.rows(); ++v)
    offsets(3 * v + 2, 0) = float(std::abs(sheet.vertices(v, 0) - 0.5));
  const DecimatedSurface decimated = Decimate({sheet, offsets}, 4);
  ASSERT_EQ(decimated.triangles.rows(), 4);
  TriangleMesh posed = SurfaceOf(sheet, decimated);
  for (Eigen::Index v = 0; v < posed.vertices.rows(); ++v) posed.vertices(v, 2) += double(offsets(3 * v + 2, 0));
  EXPECT_NEAR(TriangleAreas(posed).sum(), std::sqrt(2.0), 1e-6) << "two slopes of 45 degrees";
  EXPECT_TRUE(UsedVertices(decimated.triangles).contains(4)) << "(0.5, 0), where the fold begins";
}

TEST(Decimation, KeepsUvOfBothSidesOfASeamAndAreasOfLabels) {
  TriangleMesh sheet = testing::FlatSheet(8);
  const Eigen::Index num_vertices = sheet.vertices.rows();
  sheet.uv.resize(2 * num_vertices, 2);  // Of the right half shifted by (2, 1).
  sheet.uv << sheet.vertices.leftCols(2), sheet.vertices.leftCols(2).rowwise() + Eigen::RowVector2d(2, 1);
  sheet.uv_triangles = sheet.triangles;
  std::vector<int> labels;
  for (int f = 0; f < sheet.triangles.rows(); ++f) {
    const bool is_right = testing::MiddleOf(sheet, sheet.triangles.row(f), 0) > 0.5;
    if (is_right) sheet.uv_triangles.row(f).array() += int(num_vertices);
    labels.push_back(testing::MiddleOf(sheet, sheet.triangles.row(f), 1) > 0.25 ? 1 : 0);
  }
  const DecimatedSurface decimated = Decimate({sheet, kNoOffsets, labels}, 8);
  EXPECT_EQ(decimated.triangles.rows(), 8) << "four rectangles";
  std::array<double, 2> areas = {0, 0};
  const Eigen::VectorXd of_triangles = TriangleAreas(SurfaceOf(sheet, decimated));
  for (Eigen::Index f = 0; f < decimated.triangles.rows(); ++f) {
    areas[size_t(labels[size_t(decimated.rows[size_t(f)])])] += of_triangles[f];
    const bool is_right = testing::MiddleOf(sheet, decimated.triangles.row(f), 0) > 0.5;
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector2d expected = sheet.vertices.row(decimated.triangles(f, k)).leftCols(2) +
                                          (is_right ? Eigen::RowVector2d(2, 1) : Eigen::RowVector2d(0, 0));
      EXPECT_EQ(sheet.uv.row(decimated.uv_triangles(f, k)), expected);
    }
  }
  EXPECT_NEAR(areas[0], 0.25, 1e-12);
  EXPECT_NEAR(areas[1], 0.75, 1e-12);
}

TEST(Decimation, DoesNotTurnTrianglesOverInUv) {
  TriangleMesh sphere = testing::Sphere(1, 3);
  sphere.uv = sphere.vertices.leftCols(2);  // Two layers, whose common border is the equator: front faces are positive.
  sphere.uv_triangles = sphere.triangles;
  const DecimatedSurface decimated = Decimate({sphere, kNoOffsets}, 100);
  const auto area = [&](const Triangles& triangles, Eigen::Index f) {
    const Eigen::RowVector2d a = sphere.uv.row(triangles(f, 0)), b = sphere.uv.row(triangles(f, 1)) - a,
                             c = sphere.uv.row(triangles(f, 2)) - a;
    return b.x() * c.y() - b.y() * c.x();
  };
  for (Eigen::Index f = 0; f < decimated.triangles.rows(); ++f)
    EXPECT_GE(area(decimated.uv_triangles, f) * area(sphere.uv_triangles, decimated.rows[size_t(f)]), 0);
}

TEST(Decimation, KeepsWhatIsToBeKeptAndWhereErrorsCountMore) {
  const TriangleMesh sheet = testing::FlatSheet(8);
  EXPECT_TRUE(UsedVertices(Decimate({.mesh = sheet, .offsets = kNoOffsets, .kept = {40}}, 4).triangles).contains(40));
  const TriangleMesh sphere = testing::Sphere(1, 4);
  std::vector<float> importance;
  for (const auto& t : sphere.triangles.rowwise()) importance.push_back(testing::MiddleOf(sphere, t, 2) > 0 ? 20 : 1);
  const DecimatedSurface decimated = Decimate({.mesh = sphere, .offsets = kNoOffsets, .importance = importance}, 300);
  const auto num_upper = std::ranges::count_if(decimated.triangles.rowwise(),
                                               [&](const auto& t) { return testing::MiddleOf(sphere, t, 2) > 0; });
  EXPECT_GT(num_upper, 180);
}

TEST(Decimation, ReportsWhatItCannotReach) {
  const DecimatedSurface decimated = Decimate({testing::Sphere(1, 1), kNoOffsets}, 0);
  EXPECT_FALSE(decimated.is_reached);
  EXPECT_GE(decimated.triangles.rows(), 4);
  EXPECT_TRUE(IsClosed(decimated.triangles));
}

TEST(Decimation, LeavesASurfaceOfFewTrianglesAsItIs) {
  const TriangleMesh sheet = testing::FlatSheet(2);
  const DecimatedSurface decimated = Decimate({sheet, kNoOffsets}, 8);
  EXPECT_EQ(decimated.triangles, sheet.triangles);
  EXPECT_EQ(decimated.rows, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Decimation, RefusesSizesThatDisagree) {
  const TriangleMesh sheet = testing::FlatSheet(2);
  testing::ExpectError([&] { Decimate({sheet, kNoOffsets, {1}}, 4); }, "1 labels for 8 triangles");
  testing::ExpectError([&] { Decimate({sheet, kNoOffsets, {}, {1}}, 4); }, "1 importances for 8 triangles");
  testing::ExpectError([&] { Decimate({sheet, kNoOffsets, {}, {}, {9}}, 4); }, "vertex 9 is to be kept, there are 9");
  const Eigen::MatrixXf few = Eigen::MatrixXf::Zero(3, 1);
  testing::ExpectError([&] { Decimate({sheet, few}, 4); }, "3 offsets for 9 vertices");
}

}  // namespace
}  // namespace daumier::geometry
