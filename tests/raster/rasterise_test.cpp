#include "raster/rasterise.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

template <class T>
Raster<T> Rasterised(const MeshTopology& topology, const std::vector<T>& positions, int height, int width,
                     Facing facing = Facing::kBoth) {
  Raster<T> raster;
  Rasterise(topology, positions.data(), height, width, facing, raster);
  return raster;
}

TEST(Rasterise, BarycentricsAreThoseWorkedOutByHand) {
  // The right triangle (0, 0), (4, 0), (0, 4): at (0.5, 0.5) b1 = x / 4, b2 = y / 4.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const auto raster = Rasterised<double>(topology, {0, 0, 3, 1, 4, 0, 7, 1, 0, 4, 3, 1}, 4, 4);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const int pixel = 4 * row + column;
      const bool is_covered = row + column < 3;  // The hypotenuse x + y = 4 is neither top nor left.
      EXPECT_EQ(raster.triangle[pixel], is_covered ? 0 : -1) << row << " " << column;
      EXPECT_DOUBLE_EQ(raster.barycentric[2 * pixel], is_covered ? 1 - (row + column + 1) / 4.0 : 0);
      EXPECT_DOUBLE_EQ(raster.barycentric[2 * pixel + 1], is_covered ? (column + 0.5) / 4 : 0);
      if (is_covered) {
        EXPECT_DOUBLE_EQ(raster.depth[pixel], 3 + 4 * (column + 0.5) / 4);
      }
    }
  }
}

TEST(Rasterise, BarycentricsAreThoseOfThePointOnTheSurfaceInPerspective) {
  // An edge from w = 1 to w = 3: the picture's middle shows the point at b = (1/w1, ...): 3/4 of the near end.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const auto raster = Rasterised<double>(topology, {0, 0, 0, 1, 12, 0, 0, 3, 0, 12, 0, 3}, 4, 4);
  // Corners at (0, 0), (4, 0), (0, 4). At (1.5, 1.5): linear weights 1/4, 3/8, 3/8.
  const double sum = 0.25 + 0.375 / 3 + 0.375 / 3;
  EXPECT_DOUBLE_EQ(raster.barycentric[2 * 5], 0.25 / sum);
  EXPECT_DOUBLE_EQ(raster.barycentric[2 * 5 + 1], 0.125 / sum);
}

TEST(Rasterise, GradientOfBarycentricsEqualsCentralDifferences) {
  const Camera camera = {.focal = 120, .centre_x = 8, .centre_y = 7, .distance = 9, .height = 14, .width = 16};
  const PositionedMesh<double> mesh = BumpyBall<double>(4, 0.5, camera);
  const auto weights = RandomNumbers<double>(2 * 14 * 16, 1);
  const auto raster = Rasterised(mesh.topology, mesh.positions, 14, 16);
  std::vector<double> gradient(mesh.positions.size());
  RasteriseBackward(mesh.topology, raster, weights.data(), gradient.data());
  const auto sum = [&](const std::vector<double>& positions) {
    return Dot(weights, Rasterised(mesh.topology, positions, 14, 16).barycentric);
  };
  EXPECT_LT(MaxDifference(sum, mesh.positions, gradient, 1e-6, [](size_t i) { return i % 4 != 2; }), 1e-6);
  EXPECT_GT(*std::max_element(gradient.begin(), gradient.end()), 0.1);
  for (size_t i = 2; i < gradient.size(); i += 4) EXPECT_EQ(gradient[i], 0);  // Depth carries no gradient.
}

TEST(Rasterise, GradientIsThatOfTheFormulaOfLaineEtAl) {
  // dL/dp0.x = G (p2'.y - p1'.y) - s g1 p2'.y and so on, an independent second form.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<double> positions = {1, 0.5, 0, 1, 9.2, 1.1, 0, 1.4, 3.3, 8.9, 0, 1.2};
  const auto raster = Rasterised(topology, positions, 6, 6);
  const int pixel = 6 * 2 + 2;
  ASSERT_EQ(raster.triangle[pixel], 0);
  std::vector<double> weights(2 * 36), gradient(12);
  const double g0 = weights[2 * pixel] = 0.7, g1 = weights[2 * pixel + 1] = -0.4;
  RasteriseBackward(topology, raster, weights.data(), gradient.data());
  double x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = positions[4 * i] - 2.5 * positions[4 * i + 3];
    y[i] = positions[4 * i + 1] - 2.5 * positions[4 * i + 3];
  }
  const double a0 = x[1] * y[2] - x[2] * y[1], a1 = x[2] * y[0] - x[0] * y[2], a2 = x[0] * y[1] - x[1] * y[0];
  const double s = 1 / (a0 + a1 + a2), b0 = a0 * s, b1 = a1 * s, common = s * (g0 * b0 + g1 * b1);
  const double expected_x[3] = {common * (y[2] - y[1]) - s * g1 * y[2], common * (y[0] - y[2]) + s * g0 * y[2],
                                common * (y[1] - y[0]) - s * g0 * y[1] + s * g1 * y[0]};
  const double expected_y[3] = {-common * (x[2] - x[1]) + s * g1 * x[2], -common * (x[0] - x[2]) - s * g0 * x[2],
                                -common * (x[1] - x[0]) + s * g0 * x[1] - s * g1 * x[0]};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(gradient[4 * i], expected_x[i], 1e-12);
    EXPECT_NEAR(gradient[4 * i + 1], expected_y[i], 1e-12);
    EXPECT_NEAR(gradient[4 * i + 3], -2.5 * (expected_x[i] + expected_y[i]), 1e-12);
  }
}

TEST(Rasterise, MemoryIsReusedWithoutTraces) {
  const Camera camera = {.focal = 60, .centre_x = 8, .centre_y = 8, .distance = 9, .height = 16, .width = 16};
  const PositionedMesh<float> first = BumpyBall<float>(4, 0.6, camera), second = BumpyBall<float>(3, 0.4, camera);
  Raster<float> reused;
  Rasterise(first.topology, first.positions.data(), 20, 18, Facing::kBoth, reused);
  Rasterise(second.topology, second.positions.data(), 16, 16, Facing::kFront, reused);
  const Raster<float> fresh = Rasterised(second.topology, second.positions, 16, 16, Facing::kFront);
  EXPECT_EQ(reused.triangle, fresh.triangle);
  EXPECT_EQ(reused.barycentric, fresh.barycentric);
  EXPECT_EQ(reused.depth, fresh.depth);
  EXPECT_EQ(reused.facing, fresh.facing);
}

}  // namespace
}  // namespace daumier::raster
