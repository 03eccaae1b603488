#include "render/photo_desk.h"

#include "core/log.h"
#include "render/draw.h"
#include "render/line_drawing.h"
#include "render/strokes.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

Image PageWithALine() {
  return RasteriseStrokes({{0, {{90, 100}, {128, 160}, {166, 100}}}}, 256, {.width = 2.5});
}

/// Paper round the line with a torn, round outline.
Image TornPaperOnDesk() {
  Image photo = PageWithALine();
  for (int row = 0; row < photo.height; ++row) {
    for (int column = 0; column < photo.width; ++column) {
      const double x = (column - 128.0) / 90.0, y = (row - 128.0) / 80.0;
      if (x * x + y * y > 1.0) photo.at(row, column) = 60;
    }
  }
  return photo;
}

TEST(ShowsDesk, PaperOnADarkerGroundDoes) {
  EXPECT_TRUE(ShowsDesk(TornPaperOnDesk()));
}

TEST(ShowsDesk, ScansBoardsAndDarkStripsDoNot) {
  EXPECT_FALSE(ShowsDesk(Image()));
  EXPECT_FALSE(ShowsDesk(Image(1, 1, 1, 0)));
  EXPECT_FALSE(ShowsDesk(Image(50, 80, 3, 90)));
  Image page = PageWithALine();
  EXPECT_FALSE(ShowsDesk(page));
  Image board = page;
  for (uint8_t& value : board.pixels) value = static_cast<uint8_t>(255 - value);
  EXPECT_FALSE(ShowsDesk(board));
  FillRectangle(page, 0, 0, 256, 30, {40, 40, 40});
  FillRectangle(page, 0, 0, 30, 256, {40, 40, 40});
  EXPECT_FALSE(ShowsDesk(page)) << "dark at two sides";
}

}  // namespace
}  // namespace daumier::render
