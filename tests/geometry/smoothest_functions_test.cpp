#include "geometry/smoothest_functions.h"

#include "geometry/normals.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::geometry {
namespace {

/// A flat rectangle of 3 x 2 cm.
TriangleMesh FineRectangle(int steps) {
  TriangleMesh mesh;
  const int columns = 3 * steps + 1, rows = 2 * steps + 1;
  mesh.vertices.resize(columns * rows, 3);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) mesh.vertices.row(r * columns + c) << double(c) / steps, double(r) / steps, 0;
  mesh.triangles.resize(2 * (columns - 1) * (rows - 1), 3);
  int t = 0;
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int v = r * columns + c;
      mesh.triangles.row(t++) << v, v + 1, v + columns + 1;
      mesh.triangles.row(t++) << v, v + columns + 1, v + columns;
    }
  }
  return mesh;
}

TEST(SmoothestFunctions, OfARectangleAreCosines) {
  const TriangleMesh mesh = FineRectangle(12);
  const SmoothestFunctions found = FindSmoothestFunctions(mesh, 4);
  // (pi m / 3)^2 + (pi n / 2)^2 for (1, 0), (0, 1), (1, 1), (2, 0).
  const double a = std::pow(std::numbers::pi / 3, 2), b = std::pow(std::numbers::pi / 2, 2);
  const double expected[] = {a, b, a + b, 4 * a};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(found.values[k], expected[k], 0.02 * expected[k]);
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    const double cosine = std::sqrt(2) * std::cos(std::numbers::pi * mesh.vertices(v, 0) / 3);
    EXPECT_NEAR(std::abs(found.functions(v, 0)), std::abs(cosine), 0.05);
  }
}

TEST(SmoothestFunctions, AreOrthonormalOverTheArea) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const TriangleMesh mesh{face.neutral, face.triangles};
  const SmoothestFunctions found = FindSmoothestFunctions(mesh, 12);
  const Eigen::VectorXd areas = VertexAreas(mesh);
  const Eigen::MatrixXd gram = found.functions.transpose() * areas.asDiagonal() * found.functions / areas.sum();
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((areas.transpose() * found.functions).cwiseAbs().maxCoeff(), 1e-5 * areas.sum()) << "no constant";
  EXPECT_GT(found.values[0], 0);
  for (int k = 1; k < 12; ++k) EXPECT_GE(found.values[k], found.values[k - 1]);
  EXPECT_EQ(FindSmoothestFunctions(mesh, 12).functions, found.functions) << "deterministic";
}

TEST(SmoothestFunctions, UnusedVerticesAreZeroAndTooManyFunctionsAnError) {
  TriangleMesh mesh = FineRectangle(3);
  mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
  mesh.vertices.bottomRows(1) << 9, 9, 9;
  EXPECT_EQ(FindSmoothestFunctions(mesh, 3).functions.bottomRows(1).cwiseAbs().maxCoeff(), 0);
  testing::ExpectError([&] { FindSmoothestFunctions(mesh, 1000); }, "1000 functions");
}

}  // namespace
}  // namespace daumier::geometry
