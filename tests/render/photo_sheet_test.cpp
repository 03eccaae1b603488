#include "render/photo_sheet.h"

#include "render/draw.h"
#include "render/strokes.h"
#include "tests/support/desk_photo.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using testing::CameraOverDesk;
using testing::Desk;
using testing::DeskPhotoOptions;

/// A face of a few strokes on a sheet.
Image FaceOnSheet(int side) {
  return RasteriseStrokes({{0, {{60, 90}, {70, 170}, {128, 220}, {186, 170}, {196, 90}}},
                           {0, {{90, 110}, {110, 105}}},
                           {0, {{146, 105}, {166, 110}}},
                           {0, {{105, 180}, {128, 185}, {151, 180}}}},
                          side, {.width = 2.5});
}

/// The largest distance of a corner from where the camera has it.
double CornerError(const PhotoSheet& sheet, const Image& drawing, const DeskPhotoOptions& options) {
  const auto camera = CameraOverDesk(drawing.height, drawing.width, options);
  const double w = drawing.width, h = drawing.height;
  const std::array<Vector2d, 4> expected = {camera.Project(0, 0), camera.Project(w, 0), camera.Project(w, h),
                                            camera.Project(0, h)};
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, (sheet.corners[i] - expected[i]).norm());
  return largest;
}

TEST(FindSheets, FindsTheCornersOnAnyDeskAtAnyTilt) {
  const Image drawing = FaceOnSheet(256);
  for (const Desk desk : {Desk::kDark, Desk::kGrey, Desk::kWood}) {
    for (const double tilt : {0.0, 3.0, 10.0, 25.0}) {
      for (const double border : {0.05, 0.3}) {
        if (border == 0.3 && tilt != 10.0) continue;
        const DeskPhotoOptions options{.desk = desk, .border = border, .tilt = tilt};
        const auto sheets = FindSheets(testing::DeskPhoto(drawing, options));
        ASSERT_FALSE(sheets.empty()) << int(desk) << " " << tilt << " " << border;
        EXPECT_LE(CornerError(sheets[0], drawing, options), 0.5) << int(desk) << " " << tilt << " " << border;
      }
    }
  }
}

TEST(FindSheets, WhatLiesOverASideOrACornerDoesNotMatter) {
  const Image drawing = FaceOnSheet(256);
  const DeskPhotoOptions options{.border = 0.12, .tilt = 5.0};
  Image photo = testing::DeskPhoto(drawing, options);
  FillRectangle(photo, photo.height / 2, 0, 14, photo.width / 5, {30, 60, 160});
  const auto corner = CameraOverDesk(256, 256, options).Project(256, 256);
  FillRectangle(photo, int(corner.y()) - 25, int(corner.x()) - 25, 60, 60, {150, 110, 90});
  const auto sheets = FindSheets(photo);
  ASSERT_FALSE(sheets.empty());
  EXPECT_LE(CornerError(sheets[0], drawing, options), 1.0);
}

TEST(FindSheets, DarkSheetOnALightDesk) {
  Image drawing = FaceOnSheet(256);
  for (uint8_t& value : drawing.pixels) value = static_cast<uint8_t>(255 - value);
  const DeskPhotoOptions options{.desk = Desk::kGrey, .border = 0.15, .tilt = 6.0};
  const auto sheets = FindSheets(testing::DeskPhoto(drawing, options));
  ASSERT_FALSE(sheets.empty());
  EXPECT_LE(CornerError(sheets[0], drawing, options), 0.6);
}

/// A rectangle of a brightness, turned about its middle, with a soft shadow round it on what lies below.
struct TurnedSheet {
  Vector2d middle, half;
  double angle;
  Vector2d At(double x, double y) const { return middle + Eigen::Rotation2Dd(angle) * Vector2d(x, y); }
};

void LaySheet(Image& photo, const TurnedSheet& sheet, uint8_t brightness, double shadow) {
  for (int row = 0; row < photo.height; ++row) {
    for (int column = 0; column < photo.width; ++column) {
      const Vector2d at = Eigen::Rotation2Dd(-sheet.angle) * (Vector2d(column + 0.5, row + 0.5) - sheet.middle);
      const double outside = (at.cwiseAbs() - sheet.half).cwiseMax(0.0).norm();
      uint8_t& value = photo.at(row, column);
      if (outside == 0.0) {
        value = brightness;
      } else if (outside < 14.0) {
        value = static_cast<uint8_t>(value * (1.0 - shadow * (1.0 - outside / 14.0)));
      }
    }
  }
}

double CornerError(const PhotoSheet& found, const TurnedSheet& sheet) {
  const double w = sheet.half.x(), h = sheet.half.y();
  const std::array<Vector2d, 4> expected = {sheet.At(-w, -h), sheet.At(w, -h), sheet.At(w, h), sheet.At(-w, h)};
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, (found.corners[i] - expected[i]).norm());
  return largest;
}

TEST(FindSheets, OnAnotherWhiteSheetOrBesideIt) {
  const TurnedSheet sheet{{300, 400}, {220, 310}, 0.02}, below{{310, 410}, {225, 315}, 0.16},
      aside{{620, 350}, {150, 210}, 0.25};
  for (const uint8_t desk : {40, 110}) {
    for (const TurnedSheet& other : {below, aside}) {
      Image photo(800, other.middle.x() > 500 ? 900 : 600, 1, desk);
      LaySheet(photo, other, 245, 0.4);
      LaySheet(photo, sheet, 245, 0.4);
      const auto sheets = FindSheets(photo);
      ASSERT_FALSE(sheets.empty()) << int(desk) << " " << other.middle.x();
      EXPECT_LE(CornerError(sheets[0], sheet), 2.0) << int(desk) << " " << other.middle.x();
    }
  }
}

TEST(FindSheets, RuledPaperIsNoSheetAmongOthers) {
  for (const int thickness : {1, 3}) {
    Image page(480, 480, 1, 250);
    for (int row = 30; row < 470; row += 40) FillRectangle(page, row, 0, thickness, 480, {120, 120, 120});
    FillRectangle(page, 0, 60, 480, thickness, {120, 120, 120});
    FillRectangle(page, 0, 400, 480, thickness, {120, 120, 120});
    EXPECT_TRUE(FindSheets(page).empty()) << thickness;
  }
}

TEST(FindSheets, ScansHaveNone) {
  EXPECT_TRUE(FindSheets(Image()).empty());
  EXPECT_TRUE(FindSheets(Image(1, 1, 1, 0)).empty());
  EXPECT_TRUE(FindSheets(Image(200, 300, 3, 90)).empty());
  Image scan = FaceOnSheet(300);
  EXPECT_TRUE(FindSheets(scan).empty());
  // A frame round the drawing is a line: there is no desk beyond it.
  for (const auto& [top, left, height, width] :
       {std::array{20, 20, 4, 260}, {276, 20, 4, 260}, {20, 20, 260, 4}, {20, 276, 260, 4}}) {
    FillRectangle(scan, top, left, height, width, {0, 0, 0});
  }
  EXPECT_TRUE(FindSheets(scan).empty());
}

}  // namespace
}  // namespace daumier::render
