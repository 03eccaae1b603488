#include "render/styles/drawn_media.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;
using daumier::testing::MeanOfPlane;

TEST(PencilDrawing, LeavesWhiteAsPaperAndHatchesTheDark) {
  const PictureLayers layers = MakePictureLayers(EmptyPictureBuffers(64, 64));
  StyleChoice choice;
  choice.coloured = 0;
  std::vector<double> means;
  for (const float light : {1.0f, 0.6f, 0.2f}) {
    Rng rng(3);
    const MediumInput input{MakeColourPlanes(64, 64, {light, light, light}), Plane(64, 64)};
    means.push_back(MeanOfPlane(PencilDrawing(input, layers, choice, rng)[0]));
  }
  EXPECT_NEAR(means[0], choice.paper[0], 0.02);
  EXPECT_LT(means[1], means[0] - 0.05);
  EXPECT_LT(means[2], means[1] - 0.1);
}

TEST(InkDrawing, IsInkAndPaperAlone) {
  const PictureLayers layers = MakePictureLayers(BallHead());
  StyleChoice choice;
  choice.coloured = 0;
  Rng rng(3);
  const MediumInput input{MakeColourPlanes(64, 64, {1, 1, 1}), Plane(64, 64)};
  const ColourPlanes drawing = InkDrawing(input, layers, choice, rng);
  EXPECT_NEAR(drawing[0].at(2, 2), choice.paper[0], 1e-5);
  EXPECT_NEAR(drawing[0].at(14, 32), choice.line_colour[0], 0.02) << "dark hair";
}

TEST(Watercolour, DarkensTheBordersOfWashes) {
  const PictureLayers layers = MakePictureLayers(EmptyPictureBuffers(64, 64));
  MediumInput input{MakeColourPlanes(64, 64, {1, 1, 1}), Plane(64, 64)};
  for (Plane& plane : input.colours) {
    for (int row = 0; row < 64; ++row) {
      for (int column = 32; column < 64; ++column) plane.at(row, column) = 0.5f;
    }
  }
  double border = 0, inside = 0;
  for (int seed = 0; seed < 8; ++seed) {
    Rng rng(seed);
    PictureLayers large = layers;
    large.scale = 1;
    const ColourPlanes painted = Watercolour(input, large, {}, rng);
    for (int row = 0; row < 64; ++row) {
      border += painted[0].at(row, 34);
      inside += painted[0].at(row, 50);
    }
  }
  EXPECT_LT(border, inside - 8 * 64 * 0.02);
}

TEST(WhiteOfPaper, IsLowerForDarkSkin) {
  const PictureLayers layers = MakePictureLayers(BallHead());
  EXPECT_GT(WhiteOfPaper(Plane(64, 64, 0.8f), layers), WhiteOfPaper(Plane(64, 64, 0.3f), layers));
  EXPECT_EQ(WhiteOfPaper(Plane(64, 64, 0.01f), layers), 0.25f);
  EXPECT_EQ(WhiteOfPaper(Plane(8, 8, 0.3f), MakePictureLayers(EmptyPictureBuffers(8, 8))), 0.95f);
}

}  // namespace
}  // namespace daumier::render
