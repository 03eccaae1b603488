#include "render/svg_canvas.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const AlignedBox2d kCanvasBox(Vector2d(0, 0), Vector2d(100, 100));
const SvgColor kPaperPaint{Vector3d::Ones(), 1.0}, kBlackPaint{}, kRedPaint{Vector3d(1, 0, 0), 1.0};

SvgPolyline SquareRing(double low, double high) {
  return {{{low, low}, {high, low}, {high, high}, {low, high}, {low, low}}};
}

TEST(SvgCanvas, AreasColorAndHideWhatLiesInThem) {
  SvgShape area{.polylines = {SquareRing(20, 60)}, .fill = kRedPaint};
  SvgCanvas canvas(kCanvasBox, kPaperPaint, 500);
  EXPECT_EQ(canvas.ColorAt({40, 40}), kPaperPaint.rgb);
  canvas.PaintArea(area, 3);
  EXPECT_EQ(canvas.ColorAt({40, 40}), kRedPaint.rgb);
  EXPECT_EQ(canvas.ColorAt({70, 40}), kPaperPaint.rgb);
  EXPECT_EQ(canvas.ColorAt({-500, 40}), kPaperPaint.rgb);
  EXPECT_TRUE(canvas.IsHidden({40, 40}, 2));
  EXPECT_FALSE(canvas.IsHidden({40, 40}, 3));
  EXPECT_FALSE(canvas.IsHidden({70, 40}, 2));
  EXPECT_FALSE(canvas.IsHidden({-500, 40}, 2));
}

TEST(SvgCanvas, TransparentAreasAreBlendedAndHideNothing) {
  SvgShape area{.polylines = {SquareRing(20, 60)}, .fill = SvgColor{Vector3d::Zero(), 0.25}};
  SvgCanvas canvas(kCanvasBox, kPaperPaint, 500);
  canvas.PaintArea(area, 0);
  EXPECT_NEAR(canvas.ColorAt({40, 40}).x(), 0.75, 0.003);
  EXPECT_FALSE(canvas.IsHidden({40, 40}, -1));
}

TEST(SvgCanvas, RulesDecideAboutHoles) {
  SvgPolyline reversed = SquareRing(40, 60);
  std::reverse(reversed.points.begin(), reversed.points.end());
  const auto color_inside = [&](const SvgPolyline& hole, FillRule rule) {
    SvgShape area{.polylines = {SquareRing(20, 80), hole}, .fill = kRedPaint, .fill_rule = rule};
    SvgCanvas canvas(kCanvasBox, kPaperPaint, 500);
    canvas.PaintArea(area, 0);
    EXPECT_EQ(canvas.ColorAt({30, 30}), kRedPaint.rgb);
    return canvas.ColorAt({50, 50});
  };
  EXPECT_EQ(color_inside(SquareRing(40, 60), FillRule::kEvenOdd), kPaperPaint.rgb);
  EXPECT_EQ(color_inside(SquareRing(40, 60), FillRule::kNonzero), kRedPaint.rgb);
  EXPECT_EQ(color_inside(reversed, FillRule::kNonzero), kPaperPaint.rgb);
}

TEST(SvgCanvas, ClipsLimitAreas) {
  SvgShape area{.polylines = {SquareRing(20, 80)}, .fill = kRedPaint};
  area.clips = {std::make_shared<SvgClip>(std::vector<SvgArea>{{{SquareRing(0, 50)}}})};
  SvgCanvas canvas(kCanvasBox, kPaperPaint, 500);
  canvas.PaintArea(area, 0);
  EXPECT_EQ(canvas.ColorAt({40, 40}), kRedPaint.rgb);
  EXPECT_EQ(canvas.ColorAt({60, 60}), kPaperPaint.rgb);
}

TEST(SvgCanvas, StrokesOfTheColorBelowErase) {
  SvgShape area{.polylines = {SquareRing(0, 50)}, .fill = kBlackPaint};
  SvgShape eraser{.polylines = {{{{0, 40}, {100, 40}}}}, .stroke = kPaperPaint, .stroke_width = 10};
  SvgCanvas canvas(kCanvasBox, kPaperPaint, 500);
  canvas.PaintArea(area, 0);
  canvas.Erase(eraser, 1, 0.1);
  EXPECT_TRUE(canvas.IsHidden({70, 43}, 0));
  EXPECT_FALSE(canvas.IsHidden({70, 47}, 0));
  EXPECT_FALSE(canvas.IsHidden({30, 40}, 0)) << "on black it is a line";
}

TEST(SvgCanvas, ManyLargeAreasMakeItCoarser) {
  const std::vector<SvgShape> shapes(20000, SvgShape{.polylines = {SquareRing(0, 100)}, .fill = kRedPaint});
  EXPECT_LT(SvgCanvas::SideFor(kCanvasBox, shapes), 0.5 * SvgCanvas::SideFor(kCanvasBox, {shapes[0]}));
  EXPECT_EQ(SvgCanvas(kCanvasBox, kPaperPaint, 200).step(), 0.5);
}

TEST(SvgCanvas, ContrastIsThatOfTheLargestChannel) {
  EXPECT_EQ(PaintContrast({Vector3d(1, 1, 0.5), 1.0}, Vector3d::Ones()), 0.5);
  EXPECT_EQ(PaintContrast({Vector3d(1, 1, 0.5), 0.5}, Vector3d::Ones()), 0.25);
}

}  // namespace
}  // namespace daumier::render
