#include "raster/interpolate.h"

#include "raster/rasterise.h"
#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

constexpr int kSide = 14, kPixels = kSide * kSide;

struct InterpolateTest : ::testing::Test {
  Camera camera = {.focal = 120, .centre_x = 7, .centre_y = 7, .distance = 9, .height = kSide, .width = kSide};
  PositionedMesh<double> mesh = BumpyBall<double>(4, 0.5, camera);
  int num_vertices = mesh.topology.num_vertices;
  Raster<double> raster;

  void SetUp() override { Rasterise(mesh.topology, mesh.positions.data(), kSide, kSide, Facing::kFront, raster); }
};

TEST_F(InterpolateTest, OfPositionsIsThePixelItself) {
  // (X, Y, w) at pixel f is w (f, 1): interpolation is exact on the surface in perspective.
  std::vector<double> picture(4 * kPixels);
  Interpolate(mesh.topology, raster, 4, mesh.positions.data(), picture.data());
  int num_covered = 0;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    const double *const p = &picture[4 * pixel], w = p[3];
    if (raster.triangle[pixel] < 0) {
      EXPECT_EQ(w, 0);
      continue;
    }
    ++num_covered;
    EXPECT_NEAR(p[0] / w, pixel % kSide + 0.5, 1e-9);
    EXPECT_NEAR(p[1] / w, pixel / kSide + 0.5, 1e-9);
    EXPECT_NEAR(p[2] / w, raster.depth[pixel], 1e-9);
  }
  EXPECT_GT(num_covered, 60);
}

TEST_F(InterpolateTest, GradientsEqualCentralDifferences) {
  for (const int channels : {1, 5}) {
    const auto attributes = RandomNumbers<double>(num_vertices * channels, 1);
    const auto weights = RandomNumbers<double>(kPixels * channels, 2);
    std::vector<double> by_attributes(attributes.size()), by_barycentrics(2 * kPixels);
    InterpolateBackward(mesh.topology, raster, channels, attributes.data(), weights.data(), by_attributes.data(),
                        by_barycentrics.data());
    const auto sum = [&](const Raster<double>& at, const std::vector<double>& of) {
      std::vector<double> picture(kPixels * channels);
      Interpolate(mesh.topology, at, channels, of.data(), picture.data());
      return Dot(weights, picture);
    };
    EXPECT_LT(MaxDifference([&](const auto& x) { return sum(raster, x); }, attributes, by_attributes), 1e-8);
    const auto of_barycentrics = [&](const std::vector<double>& x) {
      Raster<double> changed = raster;
      changed.barycentric = x;
      return sum(changed, attributes);
    };
    EXPECT_LT(MaxDifference(of_barycentrics, raster.barycentric, by_barycentrics), 1e-8);
  }
}

TEST_F(InterpolateTest, EitherGradientMayBeLeftOut) {
  const auto attributes = RandomNumbers<double>(num_vertices * 2, 1), weights = RandomNumbers<double>(kPixels * 2, 2);
  std::vector<double> by_attributes(attributes.size()), by_barycentrics(2 * kPixels);
  auto alone_attributes = by_attributes, alone_barycentrics = by_barycentrics;
  InterpolateBackward(mesh.topology, raster, 2, attributes.data(), weights.data(), by_attributes.data(),
                      by_barycentrics.data());
  InterpolateBackward<double>(mesh.topology, raster, 2, attributes.data(), weights.data(), alone_attributes.data(),
                              nullptr);
  InterpolateBackward<double>(mesh.topology, raster, 2, attributes.data(), weights.data(), nullptr,
                              alone_barycentrics.data());
  EXPECT_EQ(alone_attributes, by_attributes);
  EXPECT_EQ(alone_barycentrics, by_barycentrics);
}

TEST_F(InterpolateTest, SlopesEqualDifferencesOverThePicture) {
  const auto attributes = RandomNumbers<double>(num_vertices * 2, 1);
  std::vector<double> slopes(kPixels * 4);
  InterpolateSlopes(mesh.topology, raster, 2, attributes.data(), slopes.data());
  // Moving the mesh by (-step, 0) shows what lies at (step, 0) from the pixel's centre.
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> sides[2];
    for (const int side : {0, 1}) {
      auto moved = mesh.positions;
      for (int v = 0; v < num_vertices; ++v) moved[4 * v + axis] += (side == 0 ? kStep : -kStep) * moved[4 * v + 3];
      Raster<double> at;
      Rasterise(mesh.topology, moved.data(), kSide, kSide, Facing::kFront, at);
      ASSERT_EQ(at.triangle, raster.triangle);
      sides[side].resize(kPixels * 2);
      Interpolate(mesh.topology, at, 2, attributes.data(), sides[side].data());
    }
    for (int i = 0; i < 2 * kPixels; ++i) {
      EXPECT_NEAR(slopes[2 * i + axis], (sides[1][i] - sides[0][i]) / (2 * kStep), 1e-6);
    }
  }
}

}  // namespace
}  // namespace daumier::raster
