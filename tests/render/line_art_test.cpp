#include "render/line_art.h"

#include "core/error.h"
#include "render/strokes.h"
#include "tests/support/desk_photo.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace daumier::render {
namespace {

Stroke ArtEllipse(double x, double y, double width, double height) {
  Stroke stroke;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    stroke.points.push_back({float(x + width * std::cos(angle)), float(y + height * std::sin(angle))});
  }
  return stroke;
}

/// A face of eight lines, 400 x 400.
Image DrawnByLines() {
  return RasteriseStrokes({ArtEllipse(128, 128, 70, 95),
                           ArtEllipse(100, 105, 14, 7),
                           ArtEllipse(156, 105, 14, 7),
                           ArtEllipse(100, 105, 4, 4),
                           ArtEllipse(156, 105, 4, 4),
                           ArtEllipse(128, 175, 28, 9),
                           {0, {{128, 110}, {118, 145}, {134, 148}}},
                           {0, {{84, 90}, {116, 88}}}},
                          400, {.width = 2});
}

/// Every pixel from the grey value of the drawing and its place, x and y from 0 to 1.
using ColourOfPixel = std::function<std::array<double, 3>(double grey, double x, double y)>;
Image Coloured(const Image& drawing, const ColourOfPixel& colour_of) {
  Image image(drawing.height, drawing.width, 3);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto colour = colour_of(drawing.at(row, column), double(column) / image.width, double(row) / image.height);
      for (int c = 0; c < 3; ++c)
        image.at(row, column, c) = uint8_t(std::lround(std::clamp(colour[size_t(c)], 0.0, 255.0)));
    }
  }
  return image;
}

bool IsInFace(double x, double y) {
  return std::hypot((x - 0.5) / 0.27, (y - 0.5) / 0.37) < 1;
}

TEST(LineArtScore, LinesOnPaperAreADrawing) {
  EXPECT_GT(LineArtScore(DrawnByLines()), 0.95);
}

TEST(LineArtScore, PaperMayBeColouredOrBadlyLit) {
  const Image cream = Coloured(DrawnByLines(), [](double grey, double, double) -> std::array<double, 3> {
    return {0.95 * grey, 0.88 * grey, 0.7 * grey};
  });
  EXPECT_GT(LineArtScore(cream), 0.9);
  const Image lit = Coloured(DrawnByLines(), [](double grey, double x, double y) -> std::array<double, 3> {
    const double light = 0.9 - 0.4 * x - 0.1 * y * y;
    return {light * grey, light * grey, light * grey};
  });
  EXPECT_GT(LineArtScore(lit), 0.9);
}

TEST(LineArtScore, LinesMayBeLightOnDark) {
  const Image board = Coloured(DrawnByLines(), [](double grey, double, double) -> std::array<double, 3> {
    return {40 + 0.7 * (255 - grey), 60 + 0.7 * (255 - grey), 50 + 0.7 * (255 - grey)};
  });
  EXPECT_GT(LineArtScore(board), 0.9);
}

TEST(LineArtScore, BlackHairIsInk) {
  Image drawing = DrawnByLines();
  for (int row = 50; row < 110; ++row)
    for (int column = 100; column < 300; ++column) drawing.at(row, column) = 0;
  EXPECT_GT(LineArtScore(drawing), 0.85);
}

TEST(LineArtScore, ADrawingMayBeSmallInThePicture) {
  Image sheet(1600, 1600, 1);
  const Image drawing = DrawnByLines();
  for (int row = 0; row < 400; ++row)
    for (int column = 0; column < 400; ++column) sheet.at(row + 1100, column + 50) = drawing.at(row, column);
  EXPECT_GT(LineArtScore(sheet), 0.95);
}

TEST(LineArtScore, FilledColoursAreAPortrait) {
  const Image cartoon = Coloured(DrawnByLines(), [](double grey, double x, double y) -> std::array<double, 3> {
    const double share = grey / 255;
    if (!IsInFace(x, y)) return {grey, grey, grey};
    return {235 * share, 190 * share, 160 * share};
  });
  EXPECT_LT(LineArtScore(cartoon), 0.6);
}

TEST(LineArtScore, GreyShadingIsAPortrait) {
  const Image shaded = Coloured(Image(300, 300, 1), [](double, double x, double y) -> std::array<double, 3> {
    const double light = IsInFace(x, y) ? 180 - 200 * (x - 0.3) + 40 * std::sin(9 * y) : 70 + 40 * y;
    return {light, light, light};
  });
  EXPECT_LT(LineArtScore(shaded), 0.6);
}

TEST(LineArtScore, OfAPhotographTheSheetCounts) {
  for (const testing::Desk desk : {testing::Desk::kDark, testing::Desk::kWood}) {
    EXPECT_GT(LineArtScore(testing::DeskPhoto(DrawnByLines(), {.desk = desk, .border = 0.12, .tilt = 6})), 0.85)
        << int(desk);
  }
}

TEST(LineArtScore, IsOneOfBlankPaperAndZeroWithoutPaper) {
  EXPECT_EQ(LineArtScore(Image(100, 80, 3)), 1) << "blank paper";
  EXPECT_EQ(LineArtScore(Image(1, 1, 1)), 0);
  EXPECT_THROW(LineArtScore(Image()), Error);
}

TEST(LineArtScore, TellsTheSharedDrawingsFromTheSharedCaricatures) {
  const auto shared = testing::SharedData();
  if (!shared) GTEST_SKIP() << "no pictures next to the checkout";
  const auto scores = [](const std::filesystem::path& folder) {
    std::vector<double> found;
    if (!std::filesystem::is_directory(folder)) return found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".png" || extension == ".jpg") found.push_back(LineArtScore(ReadImage(entry.path())));
    }
    return found;
  };
  const auto num_drawings = [](const std::vector<double>& found) {
    return std::ranges::count_if(found, [](double score) { return score >= kLeastLineArt; });
  };
  const auto drawings = scores(*shared / "sketches"), caricatures = scores(*shared / "caricatures");
  EXPECT_EQ(num_drawings(drawings), std::ssize(drawings));
  EXPECT_LE(num_drawings(caricatures), 3);
  if (!drawings.empty() && !caricatures.empty()) {
    RecordProperty("least_drawing", std::to_string(*std::ranges::min_element(drawings)));
    RecordProperty("greatest_caricature", std::to_string(*std::ranges::max_element(caricatures)));
  }
}

}  // namespace
}  // namespace daumier::render
