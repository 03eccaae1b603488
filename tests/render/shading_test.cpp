#include "render/shading.h"

#include "core/error.h"
#include "tests/render/pixels.h"
#include "tests/render/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace daumier::render {
namespace {

using testing::Globe;
using testing::Square;

/// Sees [-half, half] x [-half, half].
Camera Front(double half, int size) {
  return FrontalCamera({0.0, 0.0, 0.0}, half, size);
}

int Brightness(const Image& image, int row, int column) {
  const Rgb colour = Pixel(image, row, column);
  return colour[0] + colour[1] + colour[2];
}

TEST(RenderMesh, IsTheBackgroundWhereNothingIsDrawn) {
  const Rgb background = {12, 200, 77};
  const Image image = RenderMesh({Square()}, Front(2.0, 16), {.background = background});
  ASSERT_EQ(image.height, 16);
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.channels, 3);
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      const bool inside = row >= 4 && row < 12 && column >= 4 && column < 12;
      EXPECT_EQ(Pixel(image, row, column) == background, !inside) << row << " " << column;
    }
  }
}

TEST(RenderMesh, AFlatPixelHasJustItsColour) {
  const ShadingStyle flat{.clay = {90, 140, 33}, .flatness = 1.0};
  EXPECT_EQ(Pixel(RenderMesh({Square()}, Front(2.0, 16), flat), 8, 8), flat.clay);
  RenderInput coloured{Square()};
  coloured.vertex_colours.assign(4, Rgb{200, 100, 50});
  EXPECT_EQ(Pixel(RenderMesh(coloured, Front(2.0, 16), flat), 8, 8), (Rgb{200, 100, 50}));
}

TEST(RenderMesh, ColoursRunBetweenVerticesInLinearLight) {
  RenderInput ramp{Square()};
  ramp.vertex_colours = {kBlack, kWhite, kWhite, kBlack};
  const Image image = RenderMesh(ramp, Front(1.0, 15), {.flatness = 1.0});
  EXPECT_NEAR(image.at(7, 7), 188, 1) << "half of white is 188 in sRGB";
  EXPECT_LT(image.at(7, 3), image.at(7, 7));
  EXPECT_GT(image.at(7, 11), image.at(7, 7));
}

TEST(RenderMesh, SamplesAreAveragedInLinearColour) {
  // The square's right edge is at 12.5 of 16 pixels: with 2 samples a side half of column 12 is white on black.
  RenderInput square{Square()};
  square.surface.vertices.col(0).array() += 0.125;
  const Image image =
      RenderMesh(square, Front(2.0, 16), {.clay = kWhite, .background = kBlack, .flatness = 1.0, .supersampling = 2});
  EXPECT_EQ(Pixel(image, 8, 11), kWhite);
  EXPECT_EQ(Pixel(image, 8, 12), (Rgb{188, 188, 188}));
  EXPECT_EQ(Pixel(image, 8, 13), kBlack);
}

TEST(RenderMesh, IsBrightestWhereTheKeyLightComesFrom) {
  const Image image = RenderMesh({Globe(80)}, Front(1.1, 100));
  EXPECT_GT(Brightness(image, 30, 30), Brightness(image, 50, 50));
  EXPECT_GT(Brightness(image, 30, 30), Brightness(image, 30, 70));
  EXPECT_GT(Brightness(image, 30, 30), Brightness(image, 70, 30));
  EXPECT_GT(Brightness(image, 50, 50), Brightness(image, 85, 65));
  // Warm from the upper left, cool from the right.
  const auto warmth = [&](int row, int column) { return double(image.at(row, column, 0)) / image.at(row, column, 2); };
  EXPECT_GT(warmth(30, 30), warmth(60, 90));
}

TEST(RenderMesh, LightsAreFixedToTheCamera) {
  // A sphere of 80 columns looks the same after a quarter of a turn.
  const auto sphere = Globe(80);
  const Image front = RenderMesh({sphere}, Front(1.1, 64));
  const Image side = RenderMesh({sphere}, SideCamera({0.0, 0.0, 0.0}, 1.1, 64));
  EXPECT_LE(LargestDifference(front, side), 2);
}

TEST(RenderMesh, PerspectiveFromFarAwayLooksOrthographic) {
  const auto sphere = Globe(60);
  const Camera camera = Front(1.3, 48);
  EXPECT_LE(LargestDifference(RenderMesh({sphere}, camera), RenderMesh({sphere}, WithPerspective(camera, 1e5))), 3);
}

TEST(RenderMesh, TrianglesSeenFromInsideAreLitHalfAsMuch) {
  RenderInput inside{Square()};
  inside.surface.triangles.col(1).swap(inside.surface.triangles.col(2));
  const ShadingStyle flat{.clay = kWhite, .flatness = 1.0};
  const Camera camera = Front(2.0, 16);
  EXPECT_EQ(RenderMesh(inside, camera, flat).at(8, 8), 188);
  EXPECT_EQ(RenderMesh(inside, WithPerspective(camera, 30.0), flat).at(8, 8), 188);
  EXPECT_EQ(RenderMesh({Square()}, WithPerspective(camera, 30.0), flat).at(8, 8), 255);
}

TEST(RenderMesh, OfASolidLeavesOutWhatIsSeenFromInside) {
  RenderInput turned{Square()};
  turned.surface.triangles.col(1).swap(turned.surface.triangles.col(2));
  turned.is_solid = true;
  const Rgb background = {12, 200, 77};
  EXPECT_EQ(Pixel(RenderMesh(turned, Front(2.0, 16), {.background = background}), 8, 8), background);
}

TEST(RenderMesh, ClosingTrianglesHaveTheirOwnColours) {
  RenderInput input{Square()};
  input.closing_triangles = input.surface.triangles.bottomRows(1);
  input.closing_colours = {{0, 0, 255}};
  input.surface.triangles.conservativeResize(1, 3);
  const Image image = RenderMesh(input, Front(1.0, 16), {.clay = {255, 0, 0}, .flatness = 1.0});
  EXPECT_EQ(Pixel(image, 12, 12), (Rgb{255, 0, 0})) << "lower right: the surface";
  EXPECT_EQ(Pixel(image, 3, 3), (Rgb{0, 0, 255})) << "upper left: the closing triangle";
}

TEST(RenderMesh, WetTrianglesHaveASmallHighlight) {
  const geometry::TriangleMesh globe = Globe(60);
  RenderInput dry{.surface = {globe.vertices, geometry::Triangles(0, 3)}, .closing_triangles = globe.triangles};
  dry.closing_colours.assign(size_t(globe.triangles.rows()), {40, 40, 40});
  RenderInput wet = dry;
  wet.closing_gloss.assign(size_t(globe.triangles.rows()), 0.8f);
  const Image without = RenderMesh(dry, Front(1.1, 60)), with = RenderMesh(wet, Front(1.1, 60));
  int num_brighter = 0, brightest = 0;
  for (size_t i = 0; i < with.pixels.size(); ++i) {
    num_brighter += with.pixels[i] > without.pixels[i] + 30;
    brightest = std::max<int>(brightest, with.pixels[i]);
  }
  EXPECT_GT(num_brighter, 0);
  EXPECT_LT(num_brighter, 3 * 60 * 60 / 50);
  EXPECT_GT(brightest, 180);
  wet.closing_gloss.pop_back();
  EXPECT_THROW(RenderMesh(wet, Front(1.1, 60)), Error);
}

TEST(LinearLight, IsThatOfTheStandard) {
  const auto [black, middle, white] = LinearLight({0, 188, 255});
  EXPECT_EQ(black, 0.0f);
  EXPECT_NEAR(middle, 0.5029, 1e-4);
  EXPECT_EQ(white, 1.0f);
}

TEST(RenderMesh, RefusesOtherNumbersOfColours) {
  const Camera camera = Front(2.0, 16);
  EXPECT_THROW(RenderMesh({Square(), std::vector<Rgb>(3)}, camera), Error);
  EXPECT_THROW(RenderMesh({Square(), {}, Square().triangles, std::vector<Rgb>(1)}, camera), Error);
  EXPECT_THROW(RenderMesh({Square(), {}, {}, std::vector<Rgb>(1)}, camera), Error);
}

/// The square with the picture's corners at its own.
RenderInput TexturedSquare(Image texture) {
  RenderInput input{Square()};
  input.surface.uv.resize(4, 2);
  input.surface.uv << 0, 0, 1, 0, 1, 1, 0, 1;
  input.surface.uv_triangles = input.surface.triangles;
  input.texture = std::make_shared<const Image>(std::move(texture));
  return input;
}

TEST(RenderMesh, ATextureLiesOnTheSurfaceWithItsFirstRowOnTop) {
  Image texture(2, 2, 3, 0);
  texture.at(0, 0, 0) = texture.at(0, 1, 1) = texture.at(1, 0, 2) = 255;  // Red, green; blue, black.
  const Image image = RenderMesh(TexturedSquare(texture), Front(1.0, 16), {.flatness = 1.0});
  EXPECT_EQ(Pixel(image, 1, 1), (Rgb{255, 0, 0}));
  EXPECT_EQ(Pixel(image, 1, 14), (Rgb{0, 255, 0}));
  EXPECT_EQ(Pixel(image, 14, 1), (Rgb{0, 0, 255}));
  EXPECT_EQ(Pixel(image, 14, 14), kBlack);
}

TEST(RenderMesh, ATextureIsInterpolatedInLinearLight) {
  Image texture(1, 2, 3, 0);
  for (int k = 0; k < 3; ++k) texture.at(0, 1, k) = 255;
  const Image image = RenderMesh(TexturedSquare(texture), Front(1.0, 15), {.flatness = 1.0});
  EXPECT_NEAR(image.at(7, 7), 188, 1) << "half of white is 188 in sRGB";
}

TEST(RenderMesh, RefusesATextureThatIsGreyOrHasNoUv) {
  EXPECT_THROW(RenderMesh(TexturedSquare(Image(2, 2, 1)), Front(1.0, 16)), Error);
  RenderInput bare = TexturedSquare(Image(2, 2, 3));
  bare.surface = Square();
  EXPECT_THROW(RenderMesh(bare, Front(1.0, 16)), Error);
}

TEST(RenderMesh, RefusesTrianglesOfMissingVertices) {
  RenderInput surface{Square()}, closing{Square()};
  surface.surface.triangles(1, 2) = 4;
  EXPECT_THROW(RenderMesh(surface, Front(2.0, 16)), Error);
  closing.closing_triangles = surface.surface.triangles;
  closing.closing_colours.resize(2);
  EXPECT_THROW(RenderMesh(closing, Front(2.0, 16)), Error);
}

}  // namespace
}  // namespace daumier::render
