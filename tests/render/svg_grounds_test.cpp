#include "render/svg_grounds.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace daumier::render {
namespace {

using enum AreaReading;

SvgScene SceneOfAreas(const std::string& elements) {
  return ReadSvgScene(SvgDocument("a.svg", "<svg width='200' height='200'>" + elements + "</svg>"), {}, 1e-3);
}
std::vector<AreaReading> Readings(const std::string& elements) {
  return ReadingOfAreas(SceneOfAreas(elements), SvgColor{Eigen::Vector3d::Ones(), 1.0}, 200);
}
using Expected = std::vector<AreaReading>;

TEST(SvgGrounds, ManyPaleAreasOverEachOtherAreAllCompared) {
  constexpr int kNumWashes = 4000;
  std::string elements;
  for (int i = 0; i < kNumWashes; ++i)
    elements += fmt::format("<circle cx='{}' cy='{}' r='60' fill='#ddd'/>", 95 + i % 11, 95 + i / 11 % 11);
  Expected expected(kNumWashes, kNothing);
  expected.push_back(kPen);
  EXPECT_EQ(Readings(elements + "<path d='M90 90H110V92H90Z'/>"), expected);
}

TEST(SvgGrounds, OnlyRectanglesOverTheSheetCoverIt) {
  const SvgScene scene = SceneOfAreas(
      "<rect width='200' height='199' rx='5'/><rect width='200' height='150'/><circle cx='100' cy='100' r='300'/>");
  EXPECT_TRUE(CoversSheet(scene, scene.shapes[0]));
  EXPECT_FALSE(CoversSheet(scene, scene.shapes[1]));
  EXPECT_FALSE(CoversSheet(scene, scene.shapes[2]));
}

TEST(SvgGrounds, StrokesOfTheAreasColourAreJoined) {
  const auto is_joined = [](const std::string& attributes) {
    SvgScene scene = SceneOfAreas("<path " + attributes + "/>");
    JoinStrokesWithAreas(scene);
    return !scene.shapes[0].stroke.has_value();
  };
  const std::string bar = "d='M10 10H90V16H10Z' ";  // 480 * 2 / 172 = 5.6 wide.
  EXPECT_TRUE(is_joined(bar + "fill='#222' stroke='#222' stroke-width='5.5'"));
  EXPECT_FALSE(is_joined(bar + "fill='#222' stroke='#222' stroke-width='5.7'"));
  EXPECT_TRUE(is_joined(bar + "fill='#222' stroke='#2a2a2a'"));
  EXPECT_FALSE(is_joined(bar + "fill='#222' stroke='#a00'"));
  EXPECT_FALSE(is_joined(bar + "stroke='#000'")) << "the fill is not given";
  EXPECT_FALSE(is_joined("d='M10 10H90V16H10' fill='#222' stroke='#222'")) << "open";
  EXPECT_TRUE(is_joined("d='M10 10H90V10.5H10Z' fill='#222' stroke='#222' stroke-width='1'")) << "a sliver";
  EXPECT_FALSE(is_joined("d='M10 10H90Z' fill='#222' stroke='#222' stroke-width='1'")) << "no inside";
}

TEST(SvgGrounds, AreasOfTheGroundAreHolesUnlessTheInkIsThick) {
  const std::string white = "<circle cx='100' cy='100' r='46' fill='white'/>";
  EXPECT_EQ(Readings("<circle cx='100' cy='100' r='50'/>" + white), (Expected{kPen, kNothing}));
  EXPECT_EQ(Readings("<circle cx='100' cy='100' r='80'/>" + white), (Expected{kPen, kPen}));
  EXPECT_EQ(Readings("<rect x='20' y='20' width='160' height='160'/>" + white), (Expected{kOutlines, kPen}));
  EXPECT_EQ(Readings("<rect width='200' height='200'/>" + white), (Expected{kNothing, kPen}));
  EXPECT_EQ(Readings("<rect width='200' height='200' fill='#eda'/><circle cx='100' cy='100' r='50'/>"
                     "<circle cx='100' cy='100' r='46' fill='#eda'/>"),
            (Expected{kNothing, kPen, kNothing}));
}

TEST(SvgGrounds, AFrameIsNoGround) {
  EXPECT_EQ(Readings("<path fill-rule='evenodd' d='M0 0H200V200H0ZM4 4V196H196V4Z'/><path d='M40 100H160V106H40Z'/>"),
            (Expected{kNothing, kPen}));
}

TEST(SvgGrounds, LayersOfOneTranslucentColourAreReadByTheDarkest) {
  const auto layer = [](const std::string& opacity, double radius) {
    return fmt::format("<circle cx='100' cy='100' r='{}' fill-opacity='{}'/>", radius, opacity);
  };
  EXPECT_EQ(Readings(layer("0.25", 12) + layer("0.6", 11) + layer("0.9", 10)), (Expected{kNothing, kNothing, kPen}));
  EXPECT_EQ(Readings(layer("0.25", 12)), (Expected{kPen}));
}

TEST(SvgGrounds, ShadesOfAnEdgeAreNoLines) {
  const std::string bar = "<path d='M40 100H160V106H40Z' fill='#111'/>";
  const std::string shade = "<path d='M40 98.8H160V100H40Z' fill='#888' ";
  EXPECT_EQ(Readings(shade + "/>" + bar), (Expected{kNothing, kPen}));
  EXPECT_EQ(Readings(bar + shade + "/>"), (Expected{kPen, kNothing}));
  EXPECT_EQ(Readings(bar + shade + "stroke='#888'/>"), (Expected{kPen, kShade}));
  EXPECT_EQ(Readings(bar + shade + "transform='translate(0,-30)'/>"), (Expected{kPen, kPen}));
  EXPECT_EQ(Readings(bar + "<path d='M40 93H160V98H40Z' fill='#888'/>"), (Expected{kPen, kPen})) << "a line of its own";
}

}  // namespace
}  // namespace daumier::render
