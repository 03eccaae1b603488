#include "render/styles/picture_lines.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(DrawPictureLines, NoneAreNoInk) {
  const PictureBuffers buffers = daumier::testing::BallHead();
  const PictureLayers layers = MakePictureLayers(buffers);
  StyleChoice choice;
  Rng rng(1);
  EXPECT_EQ(daumier::testing::MeanOfPlane(DrawPictureLines(buffers, layers, choice, rng)), 0);
  choice.lines = LineSource::kBuffers;
  const double thin = daumier::testing::MeanOfPlane(DrawPictureLines(buffers, layers, choice, rng));
  choice.line_width = 6;
  EXPECT_GT(daumier::testing::MeanOfPlane(DrawPictureLines(buffers, layers, choice, rng)), 1.2 * thin);
  EXPECT_GT(thin, 0.005);
}

TEST(InkOver, IsTheColourOrADarkShade) {
  StyleChoice choice;
  choice.line_colour = {0.1f, 0.2f, 0.3f};
  ColourPlanes colours = MakeColourPlanes(1, 1, {0.8f, 0.8f, 0.8f});
  InkOver(colours, Plane(1, 1, 0.5f), choice);
  EXPECT_NEAR(colours[2].values[0], 0.55f, 1e-6);
  choice.line_tint = 1;
  colours = MakeColourPlanes(1, 1, {1, 0.5f, 0});
  InkOver(colours, Plane(1, 1, 1), choice);
  EXPECT_NEAR(colours[0].values[0], 0.4f, 1e-6);
  EXPECT_NEAR(colours[2].values[0], 0, 1e-6);
}

}  // namespace
}  // namespace daumier::render
