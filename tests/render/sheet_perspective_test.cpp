#include "render/sheet_perspective.h"

#include "core/error.h"
#include "render/strokes.h"
#include "tests/support/desk_photo.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using testing::CameraOverDesk;
using testing::DeskPhotoOptions;

/// A few strokes on a sheet.
Image StrokesOnSheet(int side) {
  return RasteriseStrokes({{0, {{60, 90}, {70, 170}, {128, 220}, {186, 170}, {196, 90}}},
                           {0, {{90, 110}, {110, 105}}},
                           {0, {{146, 105}, {166, 110}}},
                           {0, {{105, 180}, {128, 185}, {151, 180}}}},
                          side, {.width = 2.5});
}

/// The corners of a rectangle under a camera.
PhotoSheet RectangleUnder(const testing::DeskCamera& camera, double width, double height) {
  return {{camera.Project(0, 0), camera.Project(width, 0), camera.Project(width, height), camera.Project(0, height)}};
}

TEST(SheetAspect, UndoesThePerspective) {
  // 1.18 is far from all formats; the estimate itself is exact, as the camera looks at the middle.
  for (const double tilt : {5.0, 20.0}) {
    const auto camera = CameraOverDesk(500, 590, {.border = 0.1, .tilt = tilt});
    EXPECT_NEAR(SheetAspect(RectangleUnder(camera, 590, 500), camera.height, camera.width), 1.18, 0.012) << tilt;
  }
  EXPECT_NEAR(SheetAspect({{Vector2d(10, 10), Vector2d(128, 10), Vector2d(128, 110), Vector2d(10, 110)}}, 120, 140),
              1.18, 1e-9);
}

TEST(SheetAspect, IsThatOfTheNearestFormat) {
  const auto upright = [](double width, double height) {
    const PhotoSheet sheet{{Vector2d(0, 0), Vector2d(width, 0), Vector2d(width, height), Vector2d(0, height)}};
    return SheetAspect(sheet, int(height), int(width));
  };
  EXPECT_EQ(upright(300, 306), 1.0);
  EXPECT_NEAR(upright(210, 299), 210.0 / 297.0, 1e-4) << "A4";
  EXPECT_NEAR(upright(298, 210), std::sqrt(2.0), 1e-4);
}

TEST(RectifySheet, IsTheDrawingAgain) {
  const Image drawing = StrokesOnSheet(256);
  const DeskPhotoOptions options{.border = 0.1, .tilt = 12.0, .noise = 0.0};
  const Image photo = testing::DeskPhoto(drawing, options);
  const auto camera = CameraOverDesk(256, 256, options);
  const Image flat = RectifySheet(photo, RectangleUnder(camera, 256, 256));
  EXPECT_EQ(flat.channels, 3);
  EXPECT_EQ(flat.height, flat.width);
  // Without its edge strip, at its own size, ink is where the drawing has it.
  int num_ink = 0, num_agreeing = 0;
  const double cut = 0.012, scale = 256.0 * (1.0 - 2.0 * cut) / flat.width;
  for (int row = 0; row < flat.height; ++row) {
    for (int column = 0; column < flat.width; ++column) {
      const double value =
          testing::SampleDrawing(drawing, 256 * cut + scale * (column + 0.5), 256 * cut + scale * (row + 0.5));
      if (value > 30) continue;
      ++num_ink;
      num_agreeing += flat.at(row, column) < 130;
    }
  }
  EXPECT_GT(num_ink, 500);
  EXPECT_GT(num_agreeing, 0.98 * num_ink);
  EXPECT_THROW(RectifySheet(Image(), RectangleUnder(camera, 256, 256)), Error);
}

TEST(RectifySheet, PixelsOfItAreMappedToThoseOfThePhotograph) {
  const auto camera = CameraOverDesk(256, 256, {.border = 0.1, .tilt = 12.0});
  const PhotoSheet sheet = RectangleUnder(camera, 256, 256);
  const Image flat = RectifySheet(Image(camera.height, camera.width, 1, 255), sheet);
  const Eigen::Matrix3d homography = PictureFromRectified(sheet, camera.height, camera.width);
  // The middle of the sheet, and a place at a tenth of both sides.
  const double cut = 0.012 * 256, scale = (256 - 2 * cut) / flat.width;
  for (const Vector2d& on_sheet : {Vector2d(128, 128), Vector2d(26, 200)}) {
    const Vector2d pixel = (on_sheet - Vector2d(cut, cut)) / scale;
    const Vector2d in_picture = (homography * pixel.homogeneous()).hnormalized();
    EXPECT_LT((in_picture - camera.Project(on_sheet.x(), on_sheet.y())).norm(), 1.0);
  }
}

}  // namespace
}  // namespace daumier::render
