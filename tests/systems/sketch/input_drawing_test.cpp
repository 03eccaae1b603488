#include "systems/sketch/input_drawing.h"

#include "core/error.h"
#include "render/svg.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::sketch {
namespace {

TEST(InputDrawing, APictureIsTracedAndAMeshRefused) {
  render::Image picture(200, 200, 1, 255);
  for (int x = 40; x < 160; ++x)
    for (int y = 99; y < 102; ++y) picture.at(y, x) = 0;
  const render::Drawing drawing = DrawingOf(picture);
  ASSERT_FALSE(drawing.strokes.empty());
  for (const auto& point : drawing.strokes[0].points) EXPECT_NEAR(point[1], 100.5, 1.5);
  EXPECT_EQ(DrawingOf(drawing).strokes.size(), drawing.strokes.size());
  testing::ExpectError([] { DrawingOf(geometry::PolygonMesh{}); }, "daumier draw");
}

TEST(InputDrawing, ExtensionsAreInLowerCaseAndHoldPictures) {
  const auto extensions = DrawingExtensions();
  EXPECT_TRUE(std::ranges::find(extensions, ".png") != extensions.end());
  EXPECT_TRUE(std::ranges::find(extensions, ".svg") != extensions.end());
  testing::ExpectError([] { ReadDrawingInputs("absent.svg"); }, "absent.svg");
}

}  // namespace
}  // namespace daumier::sketch
