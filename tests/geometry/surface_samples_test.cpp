#include "geometry/surface_samples.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

/// A unit square of two triangles, one of them cut in two, and a triangle without area.
TriangleMesh Square() {
  TriangleMesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 2, 0, 4, 2, 0, 4, 3, 4, 2, 3;
  return mesh;
}

Eigen::RowVector3d PointOf(const TriangleMesh& mesh, const SurfaceSamples& samples, int s) {
  const float w0 = samples.weights[2 * size_t(s)], w1 = samples.weights[2 * size_t(s) + 1];
  const auto corners = mesh.triangles.row(samples.triangles[size_t(s)]);
  return w0 * mesh.vertices.row(corners[0]) + w1 * mesh.vertices.row(corners[1]) +
         (1 - w0 - w1) * mesh.vertices.row(corners[2]);
}

TEST(SampleSurface, IsUniformByArea) {
  const TriangleMesh mesh = Square();
  Rng rng(1);
  constexpr int kCount = 40000;
  const SurfaceSamples samples = SampleSurface(mesh, kCount, rng);
  ASSERT_EQ(samples.triangles.size(), size_t(kCount));
  ASSERT_EQ(samples.weights.size(), 2 * size_t(kCount));
  constexpr int kCells = 5;
  std::vector<int> counts(kCells * kCells);
  for (int s = 0; s < kCount; ++s) {
    const Eigen::RowVector3d p = PointOf(mesh, samples, s);
    ++counts[size_t(std::min(kCells - 1, int(p.x() * kCells)) * kCells + std::min(kCells - 1, int(p.y() * kCells)))];
  }
  double chi_square = 0;
  const double expected = double(kCount) / (kCells * kCells);
  for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi_square, 51.2);  // 24 degrees of freedom, p = 0.001.
}

TEST(SampleSurface, WeightsAreBarycentricAndTrianglesWithoutAreaGetNone) {
  Rng rng(2);
  const SurfaceSamples samples = SampleSurface(Square(), 20000, rng);
  for (size_t s = 0; s < samples.triangles.size(); ++s) {
    ASSERT_TRUE(samples.triangles[s] == 0 || samples.triangles[s] == 2 || samples.triangles[s] == 3);
    const float w0 = samples.weights[2 * s], w1 = samples.weights[2 * s + 1];
    ASSERT_GE(w0, 0);
    ASSERT_GE(w1, 0);
    ASSERT_GE(1 - w0 - w1, 0);
  }
}

TEST(SampleSurface, IsAFunctionOfTheGenerator) {
  Rng one(3), same(3), other(4);
  const SurfaceSamples a = SampleSurface(Square(), 100, one), b = SampleSurface(Square(), 100, same),
                       c = SampleSurface(Square(), 100, other);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_NE(a.weights, c.weights);
}

TEST(SampleSurface, SurfacesWithoutAreaAreRefused) {
  TriangleMesh mesh = Square();
  Rng rng(5);
  mesh.vertices.setZero();
  testing::ExpectError([&] { SampleSurface(mesh, 1, rng); }, "without area");
  testing::ExpectError([&] { SampleSurface({}, 1, rng); }, "without area");
}

}  // namespace
}  // namespace daumier::geometry
