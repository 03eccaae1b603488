#include "render/svg_ink.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

/// The ink of elements on a sheet of 200 x 200, and the problems that they have.
struct InkOfElements {
  std::vector<Stroke> strokes;
  std::vector<std::string> problems;
};
InkOfElements InkOf(const std::string& elements, const std::string& attributes = "width='200' height='200'") {
  SvgScene scene = ReadSvgScene(SvgDocument("a.svg", "<svg " + attributes + ">" + elements + "</svg>"), {}, 1e-3);
  InkOfElements ink;
  ink.strokes = InkOfScene(scene);
  ink.problems = scene.problems;
  return ink;
}
size_t NumStrokes(const std::string& elements) {
  const InkOfElements ink = InkOf(elements);
  EXPECT_TRUE(ink.problems.empty()) << elements << ": " << ink.problems[0];
  return ink.strokes.size();
}

/// A drawing of two curves between 60 and 140.
const std::string kTwoCurves =
    "<g fill='none' stroke='black'><path d='M60 60Q100 180 140 60'/><path d='M80 100Q100 120 120 100'/></g>";

TEST(SvgInk, AnAreaOfVeryManyPointsIsRefused) {
  std::string data = "M0 0";
  for (size_t i = 0; i <= kMostPointsOfArea; ++i) data += i % 2 == 0 ? "L9 9" : "L1 3";
  testing::ExpectError([&] { InkOf("<path d='" + data + "'/>"); }, "a filled path has");
  EXPECT_EQ(NumStrokes("<path fill='none' stroke='black' d='" + data + "'/>"), 1U);
}

TEST(SvgInk, PaperColoredStrokesAreNone) {
  for (const std::string color : {"#fff", "#fefefe", "rgb(98% 99% 100%)", "rgba(0,0,0,.02)", "hsl(60, 100%, 99%)"})
    EXPECT_EQ(NumStrokes(kTwoCurves + "<path fill='none' stroke='" + color + "' d='M-90 20H290L-90 40'/>"), 2U)
        << color;
  EXPECT_EQ(NumStrokes(kTwoCurves + "<path fill='none' stroke='#ccc' d='M20 20H90'/>"), 3U);
  EXPECT_EQ(NumStrokes(kTwoCurves + "<path fill='#fffffe' d='M20 20H90V50Z'/>"), 2U);
}

TEST(SvgInk, SheetsAndFramesAreNone) {
  for (const std::string frame :
       {"<rect width='200' height='200' rx='8' fill='#f4f1ea'/>",
        "<rect x='8' y='8' width='184' height='184' fill='#fefefe'/>",
        "<rect x='8' y='8' width='184' height='184' fill='#d8cfb8'/>",
        "<rect x='4' y='4' width='192' height='192' fill='none' stroke='black'/>",
        "<path d='M4 4h192v192h-192z' fill='none' stroke='#000'/>",
        "<rect x='4' y='4' width='192' height='192' rx='30' fill='none' stroke='black'/>",
        "<rect x='6' y='6' width='190' height='190' fill='#888'/><rect x='3' y='3' width='190' height='190' "
        "fill='#fff' stroke='#000'/>",
        "<path fill-rule='evenodd' d='M0 0H200V200H0ZM4 4V196H196V4Z'/>",
        "<g stroke='black'><path d='M3 3H197'/><path d='M197 3V197'/><path d='M3 197H197'/><path d='M3 3V197'/></g>",
        "<rect x='-50' y='-50' width='300' height='300' fill='#999'/>"}) {
    EXPECT_EQ(NumStrokes(frame + kTwoCurves), 2U) << frame;
  }
}

TEST(SvgInk, SmallFramesAreReported) {
  const InkOfElements ink =
      InkOf("<rect x='50' y='50' width='100' height='100' fill='none' stroke='black'/>" + kTwoCurves);
  EXPECT_EQ(ink.strokes.size(), 2U);
  ASSERT_EQ(ink.problems.size(), 1U);
  EXPECT_EQ(ink.problems[0], "a.svg: a rectangle of 100 x 100 around all else is taken for a frame");
}

TEST(SvgInk, OtherRectanglesAreDrawn) {
  EXPECT_EQ(NumStrokes("<rect x='20' y='20' width='30' height='30'/>" + kTwoCurves), 3U);
  EXPECT_EQ(NumStrokes("<rect x='9' y='9' width='180' height='180' fill='none' stroke='black'/>"), 1U);
  EXPECT_EQ(NumStrokes("<ellipse cx='100' cy='100' rx='90' ry='95' fill='none' stroke='black'/>" + kTwoCurves), 3U);
}

TEST(SvgInk, ErasersCutWhatLiesBelow) {
  const InkOfElements ink = InkOf(
      "<path stroke='black' d='M0 50H200'/><path stroke='white' stroke-width='20' d='M100 0V200'/>"
      "<path stroke='black' d='M0 150H200'/>");
  ASSERT_EQ(ink.strokes.size(), 3U);
  EXPECT_NEAR(ink.strokes[0].points.back()[0], 90, 0.5);
  EXPECT_NEAR(ink.strokes[1].points.front()[0], 110, 0.5);
  EXPECT_EQ(ink.strokes[2].points, (std::vector<std::array<float, 2>>{{0, 150}, {200, 150}}));
}

TEST(SvgInk, AreasHideWhatLiesBelow) {
  const std::string cross = "<path fill='none' stroke='black' d='M0 0L200 200M200 0L0 200'/>";
  EXPECT_EQ(NumStrokes(cross + "<path fill='white' d='M-9 -9H209V209H-9Z'/>" + kTwoCurves), 2U);
  EXPECT_EQ(NumStrokes("<g><path fill='white' d='M-9 -9H209V209H-9Z'/></g>" + cross + kTwoCurves), 4U);
  const InkOfElements ink =
      InkOf("<path stroke='black' d='M0 100H200'/><circle cx='100' cy='100' r='50' fill='white' stroke='black'/>");
  ASSERT_EQ(ink.strokes.size(), 3U);
  EXPECT_NEAR(ink.strokes[0].points.back()[0], 50, 0.5);
  EXPECT_NEAR(ink.strokes[1].points.front()[0], 150, 0.5);
}

TEST(SvgInk, CrossingLinesDoNotHideEachOther) {
  EXPECT_EQ(
      NumStrokes("<g stroke='black' stroke-width='8'><path d='M0 0L200 200'/><path stroke='red' d='M200 0L0 200'/>"
                 "<path d='M0 0L200 200'/></g>"),
      3U);
}

TEST(SvgInk, LightStrokesOnDarkAreasAreInk) {
  const std::string light = "<path fill='none' stroke='white' d='M60 60Q100 180 140 60'/>";
  EXPECT_EQ(NumStrokes("<rect width='200' height='200' fill='#123'/>" + light), 1U);
  EXPECT_EQ(NumStrokes("<circle cx='100' cy='100' r='90' fill='black'/>" + light), 2U);
  EXPECT_EQ(NumStrokes("<rect width='200' height='200' fill='#123'/><path stroke='#123' d='M0 0L9 99'/>" + light), 1U);
  EXPECT_EQ(InkOf(light, "style='background-color:black'").strokes.size(), 1U);
  const InkOfElements alone = InkOf(light);
  EXPECT_EQ(alone.strokes.size(), 1U);
  ASSERT_EQ(alone.problems.size(), 1U);
  EXPECT_EQ(alone.problems[0], "a.svg: all strokes are as light as paper; the sheet is taken as dark");
  EXPECT_EQ(NumStrokes("<rect width='150' height='150' fill='white'/>"), 0U) << "an empty sheet";
}

TEST(SvgInk, ClippedStrokesEndAtTheClip) {
  const InkOfElements ink = InkOf(
      "<clipPath id='c'><rect x='50' y='0' width='100' height='200'/></clipPath>"
      "<g clip-path='url(#c)' stroke='black'><path d='M0 20H200'/><path d='M0 0V200'/></g>");
  ASSERT_EQ(ink.strokes.size(), 1U);
  EXPECT_EQ(ink.strokes[0].points, (std::vector<std::array<float, 2>>{{50, 20}, {150, 20}}));
}

TEST(SvgInk, StrokesFarFromTheSheetAreLeftOut) {
  const InkOfElements ink = InkOf("<path stroke='black' d='M900 0H999'/>" + kTwoCurves);
  EXPECT_EQ(ink.strokes.size(), 2U);
  ASSERT_EQ(ink.problems.size(), 1U);
  EXPECT_EQ(ink.problems[0], "a.svg: 1 strokes outside the sheet are left out");
  EXPECT_EQ(InkOf("<path stroke='black' d='M900 0H999'/>").strokes.size(), 1U) << "the only one";
  EXPECT_EQ(NumStrokes("<path stroke='black' d='M-900 0H999'/>" + kTwoCurves), 3U);
}

TEST(SvgInk, ALineWithoutAreaIsDrawnOnlyWhereNoStrokeIsGiven) {
  for (const std::string nothing :
       {"stroke='none'", "stroke='#0000'", "stroke='black' stroke-width='0'", "stroke='black' stroke-opacity='0'",
        "style='stroke:transparent'", "fill='none' stroke='none'"}) {
    EXPECT_EQ(NumStrokes(kTwoCurves + "<path d='M20 20L90 27' " + nothing + "/>"), 2U) << nothing;
    EXPECT_EQ(NumStrokes(kTwoCurves + "<g " + nothing + "><line x1='20' y1='20' x2='90.1' y2='27.7'/></g>"), 2U)
        << nothing;
  }
  EXPECT_EQ(NumStrokes(kTwoCurves + "<path d='M20 20L90 27'/>"), 3U);
  EXPECT_EQ(NumStrokes(kTwoCurves + "<path d='M20 20L90 27' fill='black'/>"), 3U);
}

TEST(SvgInk, AnAreaWithAThinStrokeOfItsColourIsOneLine) {
  const std::string bar = "d='M40 20H160V26H40Z' fill='#222' ";
  for (const std::string stroke :
       {"stroke='#222' stroke-width='1'", "stroke='#252525' stroke-width='2'", "stroke='none'"}) {
    const InkOfElements ink = InkOf("<path " + bar + stroke + "/>");
    ASSERT_EQ(ink.strokes.size(), 1U) << stroke;
    for (const auto& [x, y] : ink.strokes[0].points) EXPECT_NEAR(y, 23, 0.5) << stroke;
  }
  // The stroke is the line where it has another colour, and where the fill is left out by mistake.
  for (const std::string lines :
       {"d='M40 20H160V26H40Z' fill='#fed' stroke='black'", "d='M40 20H160V26H40Z' stroke='black'"}) {
    const InkOfElements ink = InkOf("<path " + lines + "/>" + kTwoCurves);
    ASSERT_EQ(ink.strokes.size(), 3U);
    EXPECT_EQ(ink.strokes[0].points.front(), (std::array<float, 2>{40, 20}));
  }
}

TEST(SvgInk, PaperOnInkIsAHole) {
  for (const std::string paper : {"#fff", "#f8f0e0"}) {
    const std::string sheet = "<path d='M0 0H200V200H0Z' fill='" + paper + "'/>";
    const InkOfElements ink =
        InkOf(sheet + "<circle cx='100' cy='100' r='40'/><circle cx='100' cy='100' r='36' fill='" + paper + "'/>");
    ASSERT_EQ(ink.strokes.size(), 1U) << paper;
    for (const auto& [x, y] : ink.strokes[0].points) EXPECT_NEAR(std::hypot(x - 100, y - 100), 38, 0.6);
  }
}

TEST(SvgInk, AreasInAFrameAreLines) {
  EXPECT_EQ(NumStrokes("<path fill-rule='evenodd' d='M4 4H196V196H4ZM8 8V192H192V8Z'/><path d='M40 100H160V106H40Z'/>"),
            1U);
}

TEST(SvgInk, AWashIsNoLine) {
  const std::string face = "<circle cx='100' cy='100' r='90' fill='#ffe0bd'";
  EXPECT_EQ(NumStrokes(face + "/>" + kTwoCurves), 2U) << "ink inside";
  EXPECT_EQ(NumStrokes(kTwoCurves + face + " fill-opacity='0.4'/>"), 2U) << "ink below that is seen";
  EXPECT_EQ(NumStrokes(face + "/><path d='M80 100H120V104H80Z'/>"), 1U) << "ink that is an area";
  EXPECT_EQ(NumStrokes("<circle cx='30' cy='30' r='25' fill='#ffe0bd'/>" + kTwoCurves), 3U) << "ink elsewhere";
  EXPECT_EQ(NumStrokes(face + "/><circle cx='100' cy='60' r='20' fill='#fcc08a'/>"), 2U) << "no darker ink";
}

TEST(SvgInk, ThickAreasAreTheirOutlines) {
  EXPECT_EQ(NumStrokes("<circle cx='100' cy='100' r='50' fill='#963'/>"), 1U);
  EXPECT_EQ(NumStrokes("<circle cx='100' cy='100' r='50' fill='#963'/><circle cx='100' cy='100' r='20' fill='#963'/>"),
            1U)
      << "the inner one is not seen";
}

}  // namespace
}  // namespace daumier::render
