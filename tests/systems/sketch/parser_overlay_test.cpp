#include "systems/sketch/parser_overlay.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

ParsedDrawing TwoLabels() {
  using enum faces::LineLabel;
  ParsedDrawing drawing;
  drawing.strokes = {{0, {{10, 10}, {20, 10}, {30, 10}, {40, 10}}}};
  drawing.labels = {{kHair, kHair, kBrow, kBrow}};
  drawing.points.fill(Eigen::Vector2d(200, 200));
  return drawing;
}

TEST(LabelRuns, APieceEndsWhereTheNextBegins) {
  const auto runs = LabelRuns(TwoLabels());
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].kind, int(faces::LineLabel::kHair));
  EXPECT_EQ(runs[0].points.size(), 3u);
  EXPECT_EQ(runs[1].kind, int(faces::LineLabel::kBrow));
  EXPECT_EQ(runs[1].points.size(), 2u);
  EXPECT_EQ(runs[0].points.back(), runs[1].points.front());
}

TEST(ParsedPicture, LinesHaveTheColoursOfTheirLabelsAndPointsAreDots) {
  ParsedDrawing drawing = TwoLabels();
  drawing.confidences.fill(1);
  const render::Image image = ParsedPicture(drawing, {.scale = 2}, 256);
  const auto pixel = [&](int x, int y) {
    const uint8_t* at = &image.pixels[3 * size_t(y * 256 + x)];
    return render::Rgb{at[0], at[1], at[2]};
  };
  for (size_t channel = 0; channel < 3; ++channel) {  // Lines are antialiased.
    EXPECT_NEAR(pixel(30, 20)[channel], ColourOf(faces::LineLabel::kHair)[channel], 30);
    EXPECT_NEAR(pixel(75, 20)[channel], ColourOf(faces::LineLabel::kBrow)[channel], 30);
  }
  EXPECT_EQ(pixel(100, 100), (render::Rgb{255, 255, 255}));
  const render::Image dots = ParsedPicture(drawing, {.scale = 0.5}, 256);
  EXPECT_EQ(dots.pixels[3 * size_t(100 * 256 + 100) + 1], 0);
}

}  // namespace
}  // namespace daumier::sketch
