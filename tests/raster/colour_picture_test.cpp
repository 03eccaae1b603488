#include "raster/colour_picture.h"

#include "tests/raster/parts_chain.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::raster {
namespace {

constexpr int kHigh = 26, kWide = 30;

/// RGB and 1 for coverage.
std::vector<double> WithCoverage(const std::vector<double>& colours) {
  std::vector<double> with;
  for (size_t i = 0; i < colours.size(); i += 3) {
    with.insert(with.end(), {colours[i], colours[i + 1], colours[i + 2], 1.0});
  }
  return with;
}

TEST(ColourPicture, IsRasteriseInterpolateAndAntialiasAndTheirGradient) {
  const Camera camera = {.focal = 210, .centre_x = 15, .centre_y = 12.5, .distance = 9};
  const PositionedMesh<double> mesh = BumpyBall<double>(7, 0.5, camera);
  const auto colours = RandomNumbers<double>(3 * mesh.topology.num_vertices, 1);
  const auto weights = RandomNumbers<double>(4 * kHigh * kWide, 2);
  for (const auto facing : {Facing::kFront, Facing::kBoth}) {
    PartsChain chain{.topology = mesh.topology, .height = kHigh, .width = kWide, .channels = 4, .facing = facing};
    chain.Forward(mesh.positions, WithCoverage(colours));
    std::vector<double> by_positions, by_colours;
    chain.Backward(WithCoverage(colours), weights, by_positions, by_colours);

    ColourPicture<double> picture;
    std::vector<double> image(4 * kHigh * kWide), fused_positions(mesh.positions.size()), fused_colours(colours.size());
    for (int repeat = 0; repeat < 2; ++repeat) {  // The second time with memory that has been used.
      picture.Forward(mesh.topology, mesh.positions.data(), colours.data(), kHigh, kWide, {.facing = facing},
                      image.data());
      picture.Backward(mesh.topology, weights.data(), fused_positions.data(), fused_colours.data());
    }
    for (size_t i = 0; i < image.size(); ++i) ASSERT_NEAR(image[i], chain.antialiased[i], 1e-12);
    for (size_t i = 0; i < by_positions.size(); ++i) ASSERT_NEAR(fused_positions[i], by_positions[i], 1e-9);
    for (size_t i = 0; i < colours.size(); ++i) {
      ASSERT_NEAR(fused_colours[i], by_colours[i / 3 * 4 + i % 3], 1e-12);
    }
    EXPECT_EQ(picture.crossings().size(), chain.crossings.size());
  }
}

TEST(ColourPicture, InFloatIsThatInDoubleToRounding) {
  const Camera camera = {.focal = 210, .centre_x = 15, .centre_y = 12.5, .distance = 9};
  const PositionedMesh<double> mesh = BumpyBall<double>(7, 0.5, camera);
  const auto colours = RandomNumbers<double>(3 * mesh.topology.num_vertices, 1);
  const std::vector<float> positions_f(mesh.positions.begin(), mesh.positions.end()),
      colours_f(colours.begin(), colours.end());
  ColourPicture<double> picture;
  ColourPicture<float> picture_f;
  std::vector<double> image(4 * kHigh * kWide);
  std::vector<float> image_f(4 * kHigh * kWide);
  picture.Forward(mesh.topology, mesh.positions.data(), colours.data(), kHigh, kWide, {}, image.data());
  picture_f.Forward(mesh.topology, positions_f.data(), colours_f.data(), kHigh, kWide, {}, image_f.data());
  EXPECT_EQ(picture.raster().triangle, picture_f.raster().triangle);
  for (size_t i = 0; i < image.size(); ++i) ASSERT_NEAR(image[i], image_f[i], 1e-3);
}

TEST(ColourPicture, CoverageIsOneInsideExactly) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<float> positions = {-90, -90, 0, 1, 90, -90, 0, 1, 0, 200, 0, 1}, colours(9, 0.3f);
  ColourPicture<float> picture;
  std::vector<float> image(4 * 64);
  picture.Forward(topology, positions.data(), colours.data(), 8, 8, {.facing = Facing::kBoth}, image.data());
  for (int pixel = 0; pixel < 64; ++pixel) {
    EXPECT_EQ(image[4 * pixel + 3], 1.0f);
    EXPECT_EQ(image[4 * pixel], 0.3f);
  }
}

TEST(ColourPicture, OfAnEmptyPictureHasNoGradient) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<float> positions = {-9, -9, 0, 1, -5, -9, 0, 1, -9, -5, 0, 1}, colours(9, 0.3f);
  ColourPicture<float> picture;
  std::vector<float> image(4 * 64, 7.0f), weights(4 * 64, 1.0f), by_positions(12, 7.0f), by_colours(9, 7.0f);
  picture.Forward(topology, positions.data(), colours.data(), 8, 8, {}, image.data());
  picture.Backward(topology, weights.data(), by_positions.data(), by_colours.data());
  EXPECT_EQ(image, std::vector<float>(4 * 64));
  EXPECT_EQ(by_positions, std::vector<float>(12));
  EXPECT_EQ(by_colours, std::vector<float>(9));
}

TEST(ColourPicture, RefusesColoursThatAreNotFinite) {
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<float> positions = {0, 0, 0, 1, 5, 0, 0, 1, 0, 5, 0, 1};
  std::vector<float> colours(9, 0.3f), image(4 * 64);
  colours[4] = std::numeric_limits<float>::quiet_NaN();
  ColourPicture<float> picture;
  testing::ExpectError([&] { picture.Forward(topology, positions.data(), colours.data(), 8, 8, {}, image.data()); },
                       "colours have a number that is not finite");
}

}  // namespace
}  // namespace daumier::raster
