#include "raster/antialias.h"

#include "tests/raster/parts_chain.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

/// Coverage of each pixel by a triangle, from 64 x 64 samples.
std::vector<double> SampledCoverage(const std::vector<double>& positions, int side) {
  constexpr int kSamples = 64;
  std::vector<double> fine = positions, coverage(size_t(side) * side);
  for (size_t v = 0; v < fine.size(); v += 4) fine[v] *= kSamples, fine[v + 1] *= kSamples;
  Raster<double> raster;
  FindVisibleTriangles(MakeTopology(std::vector<int>{0, 1, 2}, 3), fine.data(), side * kSamples, side * kSamples,
                       Facing::kBoth, raster);
  for (int row = 0; row < side * kSamples; ++row) {
    for (int column = 0; column < side * kSamples; ++column) {
      if (raster.triangle[size_t(row) * side * kSamples + column] < 0) continue;
      coverage[(row / kSamples) * side + column / kSamples] += 1.0 / (kSamples * kSamples);
    }
  }
  return coverage;
}

TEST(Antialias, OfAStraightEdgeIsTheAreaOfEachPixel) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  for (const double angle : {0.0, 0.2, 0.7, 1.1, 1.57, 2.5, 3.9, 5.5}) {
    // A half plane whose border passes near the middle of 8 x 8 pixels; its other sides are outside.
    const double nx = std::cos(angle), ny = std::sin(angle), x = 4.1 + 0.3 * nx, y = 3.8 + 0.3 * ny;
    const std::vector<double> positions = {x - 300 * ny, y + 300 * nx, 0, 1, x + 300 * ny, y - 300 * nx, 0, 1,
                                           x - 400 * nx, y - 400 * ny, 0, 1};
    PartsChain chain{.topology = topology, .height = 8, .width = 8, .channels = 1, .facing = Facing::kBoth};
    chain.Forward(positions, {1, 1, 1});
    const std::vector<double> expected = SampledCoverage(positions, 8);
    // At the picture's border the pixel beyond an edge may be missing.
    for (int row = 1; row < 7; ++row) {
      for (int column = 1; column < 7; ++column) {
        EXPECT_NEAR(chain.antialiased[8 * row + column], expected[8 * row + column], 0.01)
            << angle << " " << row << " " << column;
      }
    }
  }
}

TEST(Antialias, BlendsTheColourOfTheSurfaceAtTheEdgeWithThatOutside) {
  // Left of x = 3.3 with a colour that is x / 10, in front of a surface of colour 5: pixel 3 has 0.3 * 0.33 + 0.7 * 5.
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 3, 4, 5}, 6);
  const std::vector<double> positions = {3.3, -20, 0,  1, 3.3, 30,  0,  1, -60, 5,   0,  1,
                                         -90, -90, 40, 1, 90,  -90, 40, 1, 0,   200, 40, 1};
  PartsChain chain{.topology = topology, .height = 8, .width = 8, .channels = 1, .facing = Facing::kBoth};
  chain.Forward(positions, {0.33, 0.33, -6, 5, 5, 5});
  for (int row = 0; row < 8; ++row) {
    EXPECT_NEAR(chain.antialiased[8 * row + 2], 0.25, 1e-12);
    EXPECT_NEAR(chain.antialiased[8 * row + 3], 0.3 * 0.33 + 0.7 * 5, 1e-12);
    EXPECT_NEAR(chain.antialiased[8 * row + 4], 5, 1e-12);
  }
}

TEST(Antialias, OfASurfaceOfOneColourIsUnchangedInside) {
  const Camera camera = {.focal = 200, .centre_x = 10, .centre_y = 10, .distance = 9};
  const PositionedMesh<double> mesh = BumpyBall<double>(8, 0.4, camera);
  PartsChain chain{.topology = mesh.topology, .height = 20, .width = 20, .channels = 1};
  chain.Forward(mesh.positions, std::vector<double>(mesh.topology.num_vertices, 1.0));
  EXPECT_GT(chain.crossings.size(), 20u);
  double area = 0;
  for (const double value : chain.antialiased) {
    EXPECT_GE(value, -1e-12);
    EXPECT_LE(value, 1 + 1e-12);
    area += value;
  }
  EXPECT_NE(area, std::round(area));
}

TEST(Antialias, GradientsOfAllPartsTogetherEqualCentralDifferencesAtConstantSlope) {
  for (const auto facing : {Facing::kFront, Facing::kBoth}) {
    for (const auto projection : {Camera::Projection::kPerspective, Camera::Projection::kOrthographic}) {
      const bool perspective = projection == Camera::Projection::kPerspective;
      const Camera camera = {.projection = projection,
                             .focal = perspective ? 105.0 : 13.0,
                             .centre_x = 8.1,
                             .centre_y = 6.9,
                             .distance = 9};
      const PositionedMesh<double> mesh = BumpyBall<double>(5, 0.45, camera);
      constexpr int kHeight = 14, kWidth = 16, kChannels = 4;
      const auto colours = RandomNumbers<double>(mesh.topology.num_vertices * kChannels, 3);
      const auto weights = RandomNumbers<double>(kHeight * kWidth * kChannels, 4);
      PartsChain chain{
          .topology = mesh.topology, .height = kHeight, .width = kWidth, .channels = kChannels, .facing = facing};
      chain.Forward(mesh.positions, colours);
      const std::vector<double> slopes = chain.Slopes();
      ASSERT_GT(slopes.size(), 15u);
      std::vector<double> by_positions, by_colours;
      chain.Backward(colours, weights, by_positions, by_colours);
      const auto sum = [&](const std::vector<double>& positions, const std::vector<double>& of) {
        chain.Forward(positions, of, slopes);
        return Dot(weights, chain.antialiased);
      };
      EXPECT_LT(MaxDifference([&](const auto& x) { return sum(mesh.positions, x); }, colours, by_colours), 1e-7);
      EXPECT_LT(MaxDifference([&](const auto& x) { return sum(x, colours); }, mesh.positions, by_positions, 1e-7,
                              [](size_t i) { return i % 4 != 2; }),
                1e-5);
    }
  }
}

TEST(Antialias, InterpolatedCrossingsHaveTheValuesOfTheirEdges) {
  const std::vector<Crossing<double>> crossings = {{.first = 0, .second = 2, .weight = 0.25}};
  const std::vector<double> attributes = {1, 10, 0, 0, 5, -10};
  std::vector<double> values(2);
  InterpolateCrossings(crossings, 2, attributes.data(), values.data());
  EXPECT_EQ(values, (std::vector<double>{2, 5}));
}

}  // namespace
}  // namespace daumier::raster
