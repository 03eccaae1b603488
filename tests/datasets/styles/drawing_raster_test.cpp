#include "datasets/styles/drawing_raster.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

StyledDrawing Box(bool filled) {
  StyledDrawing drawing;
  drawing.strokes.push_back(
      {4,
       filled,
       {{64, 64}, {192, 64}, {192, 192}, {64, 192}},
       {faces::LineLabel::kHair, faces::LineLabel::kHair, faces::LineLabel::kNeck, faces::LineLabel::kNeck}});
  return drawing;
}

TEST(DrawingRaster, AreasAreBlackAsDrawnAndOutlinesWhenTraced) {
  const render::Image drawn = RasteriseDrawing(Box(true), 128, PenView::kAsDrawn);
  const render::Image traced = RasteriseDrawing(Box(true), 128, PenView::kTraced);
  EXPECT_EQ(drawn.at(64, 64), 0);
  EXPECT_EQ(drawn.at(20, 20), 255);
  EXPECT_EQ(traced.at(64, 64), 255);
  EXPECT_LT(traced.at(64, 31) + traced.at(64, 32), 400) << "the area is closed";
  EXPECT_EQ(RasteriseDrawing(Box(false), 128, PenView::kTraced).at(64, 31), 255) << "the stroke is not";
}

TEST(DrawingRaster, WidthsCountAsDrawnAlone) {
  const auto ink = [](const render::Image& image) {
    return std::count_if(image.pixels.begin(), image.pixels.end(), [](uint8_t grey) { return grey < 128; });
  };
  StyledDrawing thick = Box(false);
  thick.strokes[0].width = 8;
  EXPECT_GT(ink(RasteriseDrawing(thick, 256, PenView::kAsDrawn)),
            1.7 * double(ink(RasteriseDrawing(Box(false), 256, PenView::kAsDrawn))));
  EXPECT_EQ(RasteriseDrawing(thick, 256, PenView::kTraced), RasteriseDrawing(Box(false), 256, PenView::kTraced));
}

TEST(DrawingRaster, LabelsLieWhereTheInkIs) {
  const std::vector<int8_t> labels = RasteriseLabels(Box(false), 128);
  const render::Image ink = RasteriseDrawing(Box(false), 128, PenView::kTraced, 2);
  int num_labelled = 0;
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] == kNoLineLabel) continue;
    ++num_labelled;
    EXPECT_LT(ink.pixels[cell], 255) << cell;
  }
  EXPECT_NEAR(num_labelled, 3 * 64, 6);
  EXPECT_EQ(labels[size_t(32 * 128 + 64)], int8_t(faces::LineLabel::kHair));
  EXPECT_EQ(labels[size_t(96 * 128 + 64)], int8_t(faces::LineLabel::kNeck));
  EXPECT_EQ(labels[size_t(64 * 128 + 64)], kNoLineLabel);
}

TEST(DrawingRaster, StrokesAreDividedWhereTheirLabelChanges) {
  const std::vector<render::Stroke> strokes = LabelledStrokes(Box(false));
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[0].kind, int(faces::LineLabel::kHair));
  EXPECT_EQ(strokes[0].points.back(), strokes[1].points.front()) << "no piece is lost";
  EXPECT_EQ(strokes[1].kind, int(faces::LineLabel::kNeck));
  EXPECT_EQ(LabelledStrokes(Box(true)).back().points.back(), (std::array<float, 2>{64, 64}));
}

TEST(DrawingRaster, ColoursAreThoseOfTheLabels) {
  StyledDrawing drawing = Box(false);
  drawing.points[0] = {{20, 20}, 1};
  const render::Image image = ColouredDrawing(drawing, 256);
  const render::Rgb hair = ColourOf(faces::LineLabel::kHair);
  EXPECT_NEAR(image.at(63, 128, 0), hair[0], 40);
  EXPECT_EQ(image.at(20, 20, 1), 0) << "a point of the face";
  EXPECT_EQ(image.at(150, 150, 0), 255);
}

}  // namespace
}  // namespace daumier::datasets
