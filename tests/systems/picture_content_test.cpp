#include "systems/picture_content.h"

#include "render/strokes.h"

#include <gtest/gtest.h>

namespace daumier::systems {
namespace {

TEST(PictureContent, LineDrawingsAndPortraitsAreOpposite) {
  const render::Image drawing = render::RasteriseStrokes(
      {{0, {{60, 40}, {200, 40}, {200, 220}, {60, 220}, {60, 40}}}, {0, {{90, 100}, {110, 100}}}}, 256);
  render::Image painting(200, 200, 3);
  for (int row = 30; row < 170; ++row) {
    for (int column = 30; column < 170; ++column) {
      painting.at(row, column, 1) = uint8_t(row);
      painting.at(row, column, 2) = uint8_t(column);
    }
  }
  EXPECT_GT(LineDrawings().suits(drawing), 0);
  EXPECT_LT(LineDrawings().suits(painting), 0);
  for (const render::Image& picture : {drawing, painting})
    EXPECT_EQ(LineDrawings().suits(picture), -Portraits().suits(picture));
  EXPECT_EQ(LineDrawings().plural, "line drawings");
  EXPECT_EQ(PictureContent().suits, nullptr);
}

}  // namespace
}  // namespace daumier::systems
