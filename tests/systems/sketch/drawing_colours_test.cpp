#include "systems/sketch/drawing_colours.h"

#include "faces/annotation.h"
#include "render/draw.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::sketch {
namespace {

render::Stroke Curve(const std::string& kind, std::vector<std::array<float, 2>> points) {
  const auto& kinds = faces::CurveKinds();
  return {int(std::ranges::find(kinds, kind) - kinds.begin()), std::move(points)};
}

/// A square face with square brows, eyes and lips.
std::vector<render::Stroke> Curves() {
  std::vector<render::Stroke> curves = {Curve("silhouette", {{20, 60}, {20, 180}, {180, 180}, {180, 60}}),
                                        Curve("lips", {{80, 140}, {120, 140}, {120, 160}, {80, 160}}),
                                        Curve("upper_mouth", {{85, 149}, {115, 149}}),
                                        Curve("lower_mouth", {{115, 151}, {85, 151}})};
  for (const float x : {60.0F, 140.0F}) {
    curves.push_back(Curve("brow", {{x - 15, 62}, {x + 15, 62}, {x + 15, 70}, {x - 15, 70}}));
    curves.push_back(Curve("upper_eye", {{x - 15, 80}, {x + 15, 80}}));
    curves.push_back(Curve("lower_eye", {{x - 15, 95}, {x + 15, 95}}));
  }
  return curves;
}

void Fill(render::Image& picture, int left, int top, int right, int bottom, const render::Rgb& colour) {
  render::FillRectangle(picture, top, left, bottom - top, right - left, colour);
}

TEST(DrawnColours, AreTheMediansOfRegions) {
  render::Image picture(200, 200, 3);
  Fill(picture, 20, 60, 180, 180, {224, 172, 140});
  Fill(picture, 80, 140, 120, 160, {200, 30, 40});
  for (const int x : {60, 140}) {
    Fill(picture, x - 15, 62, x + 15, 70, {120, 70, 20});
    Fill(picture, x - 15, 80, x + 15, 95, {255, 255, 255});
    Fill(picture, x - 5, 82, x + 5, 92, {40, 90, 200});
    Fill(picture, x - 2, 85, x + 2, 89, {0, 0, 0});  // The pupil has no colour.
  }
  const DrawnColours colours = FindDrawnColours(picture, Curves());
  ASSERT_TRUE(colours.skin && colours.lips && colours.brows && colours.iris);
  EXPECT_LT((255 * *colours.skin - Eigen::Vector3f(224, 172, 140)).norm(), 1);
  EXPECT_LT((255 * *colours.lips - Eigen::Vector3f(200, 30, 40)).norm(), 1);
  EXPECT_LT((255 * *colours.brows - Eigen::Vector3f(120, 70, 20)).norm(), 1);
  EXPECT_LT((255 * *colours.iris - Eigen::Vector3f(40, 90, 200)).norm(), 1);
}

TEST(DrawnColours, ArePaperWhereNothingIsColoured) {
  render::Image picture(200, 200, 3);
  Fill(picture, 80, 140, 120, 160, {200, 30, 40});  // Lips alone.
  Fill(picture, 45, 62, 75, 70, {20, 20, 20});      // A black brow.
  const DrawnColours colours = FindDrawnColours(picture, Curves());
  EXPECT_FALSE(colours.skin);
  EXPECT_TRUE(colours.lips);
  EXPECT_FALSE(colours.brows);
  EXPECT_FALSE(colours.iris);
}

TEST(DrawnColours, OfGreyPicturesOrWithoutCurvesAreAbsent) {
  const DrawnColours grey = FindDrawnColours(render::Image(200, 200, 1, 90), Curves());
  EXPECT_FALSE(grey.skin || grey.lips || grey.brows || grey.iris);
  const DrawnColours none = FindDrawnColours(render::Image(200, 200, 3, 90), {});
  EXPECT_FALSE(none.skin || none.lips || none.brows || none.iris);
}

}  // namespace
}  // namespace daumier::sketch
