#include "render/svg_areas.h"

#include <gtest/gtest.h>

#include <memory>

namespace daumier::render {
namespace {

const SvgColor kBlackArea{Eigen::Vector3d::Zero(), 1.0}, kSkinArea{{0.9, 0.7, 0.6}, 1.0};

SvgShape BoxShape(double left, double top, double right, double bottom, const SvgColor& fill) {
  SvgShape shape;
  shape.polylines = {{{{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}}}};
  shape.fill = fill;
  return shape;
}

std::vector<std::vector<SvgAreaLine>> Lines(std::vector<SvgShape> shapes) {
  SvgScene scene;
  scene.width = scene.height = 100;
  scene.shapes = std::move(shapes);
  return LinesOfAreas(scene, std::vector<AreaReading>(scene.shapes.size(), AreaReading::kPen), 100);
}

TEST(LinesOfAreas, OfALongThinBoxIsItsMiddle) {
  const auto lines = Lines({BoxShape(20, 49, 80, 51, kBlackArea)});
  ASSERT_EQ(lines[0].size(), 1U);
  EXPECT_EQ(lines[0][0].last_of_colour, 0);
  double left = 100, right = 0;
  for (const auto& point : lines[0][0].polyline.points) {
    EXPECT_NEAR(point.y(), 50, 0.3);
    left = std::min(left, point.x());
    right = std::max(right, point.x());
  }
  EXPECT_NEAR(left, 20, 0.6);
  EXPECT_NEAR(right, 80, 0.6);
}

TEST(LinesOfAreas, OfAThickBoxIsItsExactOutline) {
  const SvgShape box = BoxShape(20, 20, 80, 81.7, kBlackArea);
  const auto lines = Lines({box});
  ASSERT_EQ(lines[0].size(), 1U);
  EXPECT_FALSE(lines[0][0].last_of_colour.has_value());
  EXPECT_EQ(lines[0][0].polyline.points, box.polylines[0].points);
}

TEST(LinesOfAreas, APenOnAColouredFaceIsStillALine) {
  const auto lines = Lines({BoxShape(10, 10, 90, 90, kSkinArea), BoxShape(20, 49, 80, 51, kBlackArea)});
  ASSERT_EQ(lines[1].size(), 1U);
  EXPECT_EQ(lines[1][0].last_of_colour, 1);
  ASSERT_EQ(lines[0].size(), 1U);
  EXPECT_FALSE(lines[0][0].last_of_colour.has_value());
}

TEST(LinesOfAreas, AColourThatIsPaintedLaterCutsALine) {
  const auto lines = Lines({BoxShape(20, 49, 80, 51, kBlackArea), BoxShape(40, 30, 60, 70, kSkinArea)});
  EXPECT_EQ(lines[0].size(), 2U);
}

TEST(LinesOfAreas, ShapesThatAreNoAreasHaveNone) {
  SvgScene scene;
  scene.width = scene.height = 100;
  scene.shapes = {BoxShape(20, 49, 80, 51, kBlackArea)};
  EXPECT_TRUE(LinesOfAreas(scene, {AreaReading::kNothing}, 100)[0].empty());
  const auto outlines = LinesOfAreas(scene, {AreaReading::kOutlines}, 100);
  ASSERT_EQ(outlines[0].size(), 1U);
  EXPECT_EQ(outlines[0][0].polyline.points, scene.shapes[0].polylines[0].points);
}

SvgShape ClippedBox(std::vector<SvgArea> areas) {
  SvgShape box = BoxShape(0, 0, 100, 100, kBlackArea);
  box.clips.push_back(std::make_shared<SvgClip>(std::move(areas)));
  return box;
}

TEST(CutAreasByClips, ARectangleSeenThroughClipsIsTheirAreas) {
  SvgScene scene;
  scene.shapes = {ClippedBox({{{{{{20, 49}, {80, 49}, {80, 51}, {20, 51}}}}, FillRule::kEvenOdd},
                              {{{{{20, 69}, {80, 69}, {80, 71}, {20, 71}}}}}})};
  CutAreasByClips(scene);
  ASSERT_EQ(scene.shapes.size(), 2U);
  for (const SvgShape& shape : scene.shapes) {
    EXPECT_TRUE(shape.clips.empty());
    ASSERT_EQ(shape.polylines.size(), 1U);
    EXPECT_EQ(shape.polylines[0].points.size(), 5U);
    EXPECT_EQ(shape.polylines[0].points.front(), shape.polylines[0].points.back());
    EXPECT_EQ(shape.fill->rgb, kBlackArea.rgb);
  }
  EXPECT_EQ(scene.shapes[0].fill_rule, FillRule::kEvenOdd);
  EXPECT_EQ(scene.shapes[1].fill_rule, FillRule::kNonzero);
  EXPECT_EQ(scene.shapes[1].polylines[0].points[0], Eigen::Vector2d(20, 69));
}

TEST(CutAreasByClips, OtherClipsAreKept) {
  const SvgArea reaches_out{{{{{20, 49}, {180, 49}, {180, 51}, {20, 51}}}}};
  SvgShape stroked = ClippedBox({{{{{{20, 49}, {80, 49}, {80, 51}}}}}}), line = stroked;
  stroked.stroke = kSkinArea;
  line.polylines = {{{{20, 20}, {80, 80}, {20, 80}}}};
  SvgScene scene;
  scene.shapes = {ClippedBox({reaches_out}), stroked, line, ClippedBox({})};
  CutAreasByClips(scene);
  ASSERT_EQ(scene.shapes.size(), 4U);
  for (const SvgShape& shape : scene.shapes) EXPECT_EQ(shape.clips.size(), 1U);
  EXPECT_EQ(scene.shapes[0].polylines[0].points.size(), 5U);
}

TEST(CutAreasByClips, OfAnAreaThroughTwoClipsTheInnerOneIsLeft) {
  SvgShape box = ClippedBox({{{{{{10, 10}, {90, 10}, {90, 90}, {10, 90}}}}}});
  box.clips.push_back(std::make_shared<SvgClip>(std::vector<SvgArea>{{{{{{20, 49}, {80, 49}, {80, 51}}}}}}));
  SvgScene scene;
  scene.shapes = {box};
  CutAreasByClips(scene);
  ASSERT_EQ(scene.shapes.size(), 1U);
  EXPECT_TRUE(scene.shapes[0].clips.empty());
  EXPECT_EQ(scene.shapes[0].polylines[0].points.size(), 4U);
}

}  // namespace
}  // namespace daumier::render
