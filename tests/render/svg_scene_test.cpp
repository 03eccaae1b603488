#include "render/svg_scene.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using testing::ExpectError;

SvgScene SceneOf(const std::string& svg, const std::vector<std::string>& kinds = {}) {
  return ReadSvgScene(SvgDocument("a.svg", svg), kinds, 1e-3);
}
/// Of elements on a sheet of 100 x 100.
SvgScene SceneOfElements(const std::string& elements) {
  return SceneOf("<svg width='100' height='100' fill='none' stroke='black'>" + elements + "</svg>");
}
/// Of elements that paint one shape of one polyline.
std::vector<Vector2d> PointsOf(const std::string& elements) {
  const SvgScene scene = SceneOfElements(elements);
  EXPECT_EQ(scene.shapes.size(), 1U) << elements;
  for (const auto& problem : scene.problems) ADD_FAILURE() << problem;
  return scene.shapes.empty() ? std::vector<Vector2d>{} : scene.shapes[0].polylines.at(0).points;
}
using ScenePoints = std::vector<Vector2d>;

TEST(SvgScene, UsesPlaceWhatTheyReferTo) {
  EXPECT_EQ(PointsOf("<defs><path id='a' d='M0 0H1'/></defs><use href='#a' x='10' y='20'/>"),
            (ScenePoints{{10, 20}, {11, 20}}));
  EXPECT_EQ(PointsOf("<defs><g id='a' transform='scale(2)'><path d='M1 1H2'/></g></defs>"
                     "<use xlink:href='#a' transform='translate(5)' x='10'/>"),
            (ScenePoints{{17, 2}, {19, 2}}));
  EXPECT_EQ(
      PointsOf("<defs><use id='b' href='#a' x='1'/></defs><defs><path id='a' d='M0 0H1'/></defs><use href='#b'/>"),
      (ScenePoints{{1, 0}, {2, 0}}));
}

TEST(SvgScene, UsedElementsInheritFromTheUse) {
  const auto scene = SceneOfElements(
      "<defs stroke='none'><path id='a' d='M0 0H1'/></defs><use href='#a' stroke='red'/><use href='#a'/>");
  ASSERT_EQ(scene.shapes.size(), 2U);
  EXPECT_EQ(scene.shapes[0].stroke->rgb.x(), 1.0);
  EXPECT_EQ(scene.shapes[1].stroke->rgb.x(), 0.0);
}

TEST(SvgScene, SymbolsAreFittedIntoTheirUse) {
  const std::string symbol = "<symbol id='a' viewBox='0 0 10 10'><path d='M1 1H2'/></symbol>";
  EXPECT_EQ(PointsOf(symbol + "<use href='#a' x='10' width='50' height='100'/>"), (ScenePoints{{15, 30}, {20, 30}}));
  EXPECT_EQ(PointsOf(symbol + "<use href='#a'/>"), (ScenePoints{{10, 10}, {20, 10}})) << "100 % of the sheet";
  EXPECT_TRUE(SceneOfElements(symbol).shapes.empty());
  EXPECT_TRUE(SceneOfElements(symbol + "<use href='#a' width='0' height='9'/>").shapes.empty());
}

TEST(SvgScene, NestedSvgsPlaceTheirContent) {
  EXPECT_EQ(PointsOf("<svg x='10' y='20' width='30' height='40'><path d='M1 1H2'/></svg>"),
            (ScenePoints{{11, 21}, {12, 21}}));
  EXPECT_EQ(PointsOf("<svg x='10%' width='50' height='50' viewBox='-5 -5 10 10'><path d='M0 0H1'/></svg>"),
            (ScenePoints{{35, 25}, {40, 25}}));
  EXPECT_EQ(
      PointsOf("<svg width='50' height='100' viewBox='0 0 10 10' preserveAspectRatio='none'><path d='M1 1V2'/></svg>"),
      (ScenePoints{{5, 10}, {5, 20}}));
  EXPECT_EQ(PointsOf("<svg width='50' height='50' viewBox='0 0 10 20'><line x2='100%' y2='50%'/></svg>"),
            (ScenePoints{{12.5, 0}, {37.5, 25}}))
      << "percentages refer to the viewBox";
  const auto clips = [](const std::string& attributes) {
    return SceneOfElements("<svg width='5' height='5' " + attributes + "><path d='M0 0H9'/></svg>").shapes.at(0).clips;
  };
  ASSERT_EQ(clips("").size(), 1U);
  EXPECT_TRUE(clips("")[0]->Contains({4, 4}));
  EXPECT_FALSE(clips("")[0]->Contains({6, 4}));
  EXPECT_TRUE(clips("overflow='visible'").empty());
}

TEST(SvgScene, SwitchDrawsItsFirstFittingChild) {
  EXPECT_EQ(
      PointsOf(
          "<switch><foreignObject requiredExtensions='http://ns.adobe.com/x'/><path systemLanguage='xx' d='M0 0V5'/>"
          "<path systemLanguage='de, en-GB' d='M0 0H1'/><path d='M0 0H2'/></switch>"),
      (ScenePoints{{0, 0}, {1, 0}}));
}

TEST(SvgScene, CyclesAreRefusedAndRepetitionIsLimited) {
  ExpectError([] { SceneOfElements("<g id='a'><use href='#a'/></g>"); }, "a.svg:1: <use>: it contains itself by '#a'");
  ExpectError([] { SceneOfElements("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>"); },
              "contains itself");
  std::string doubled = "<defs><path id='x0' d='M0 0H1'/>";
  for (int i = 1; i < 40; ++i)
    doubled += fmt::format("<g id='x{0}'><use href='#x{1}'/><use href='#x{1}'/></g>", i, i - 1);
  ExpectError([&] { SceneOfElements(doubled + "</defs><use href='#x39'/>"); }, "a.svg: the drawing is too large");
}

TEST(SvgScene, ClipPathsHoldInTheCoordinatesOfTheirElement) {
  const auto clips = [](const std::string& clip, const std::string& path) {
    const SvgScene scene = SceneOfElements(clip + path);
    EXPECT_TRUE(scene.problems.empty()) << scene.problems[0];
    return scene.shapes.at(0).clips;
  };
  const std::string path = "<g transform='translate(50 0)' clip-path='url(#c)'><path d='M0 0H9'/></g>";
  const auto plain = clips("<clipPath id='c' transform='scale(2)'><rect width='5' height='5'/></clipPath>", path);
  EXPECT_TRUE(plain.at(0)->Contains({59, 9}));
  EXPECT_FALSE(plain.at(0)->Contains({49, 9}));
  EXPECT_FALSE(plain.at(0)->Contains({61, 9}));
  const auto used =
      clips("<defs><circle id='d' r='5'/></defs><clipPath id='c'><use href='#d' x='5'/></clipPath>", path);
  EXPECT_TRUE(used.at(0)->Contains({55, 4}));
  const auto boxed =
      clips("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='1'/></clipPath>",
            "<rect x='10' y='10' width='20' height='20' clip-path='url(#c)'/>");
  EXPECT_TRUE(boxed.at(0)->Contains({19, 29}));
  EXPECT_FALSE(boxed.at(0)->Contains({21, 29}));
  const auto twice = clips(
      "<clipPath id='d'><rect width='5' height='5'/></clipPath>"
      "<clipPath id='c' clip-path='url(#d)'><rect width='9' height='9'/></clipPath>",
      path);
  EXPECT_EQ(twice.size(), 2U);
}

TEST(SvgScene, StylesDecideWhatIsPainted) {
  for (const std::string hidden :
       {"<style>.a{display:none}</style><g class='a'><path d='M0 0H9'/></g>",
        "<path style='visibility:collapse' d='M0 0H9'/>", "<g opacity='0'><path d='M0 0H9'/></g>",
        "<path stroke-width='0' d='M0 0H9'/>", "<path stroke='#0000' d='M0 0H9'/>",
        "<style>path{stroke:none!important}</style><path style='stroke:red' d='M0 0H9'/>",
        "<x:path xmlns:x='http://x' d='M0 0H9'/>", "<marker><path d='M0 0H9'/></marker>"}) {
    const SvgScene scene = SceneOfElements(hidden);
    EXPECT_TRUE(scene.shapes.empty()) << hidden;
    EXPECT_TRUE(scene.problems.empty()) << hidden;
  }
  const auto half = SceneOfElements("<g opacity='.5'><path stroke-opacity='.5' d='M0 0H9' fill='red'/></g>");
  EXPECT_EQ(half.shapes.at(0).stroke->alpha, 0.25);
  EXPECT_EQ(half.shapes.at(0).fill->alpha, 0.5);
  EXPECT_EQ(
      SceneOfElements("<g transform='scale(3)'><path stroke-width='2' d='M0 0H9'/></g>").shapes.at(0).stroke_width,
      6.0);
  EXPECT_EQ(PointsOf("<path style='transform: translate(1px, 2px)' d='M0 0H1'/>"), (ScenePoints{{1, 2}, {2, 2}}));
  EXPECT_EQ(PointsOf("<path transform='scale(2)' transform-origin='50% 0' d='M50 1H51'/>"),
            (ScenePoints{{50, 2}, {52, 2}}));
}

TEST(SvgScene, SizesOfTheSheet) {
  const auto size = [](const std::string& attributes) {
    const SvgScene scene = SceneOf("<svg " + attributes + "/>");
    return Vector2d(scene.width, scene.height);
  };
  EXPECT_EQ(size("width='1in' height='2em'"), Vector2d(96, 32));
  EXPECT_EQ(size("width='100%' height='100vh' viewBox='0 0 30 40'"), Vector2d(30, 40));
  EXPECT_EQ(size("style='width:60px;height:auto' viewBox='0 0 30 40'"), Vector2d(60, 80));
  EXPECT_EQ(size("height='20' viewBox='0 0 30 40'"), Vector2d(15, 20));
  EXPECT_EQ(size(""), Vector2d(0, 0));
  ExpectError([&] { size("width='0'"); }, "a.svg:1: <svg>: width and height must be positive");
  EXPECT_EQ(SceneOf("<svg style='background:#00f'/>").background->rgb.z(), 1.0);
}

TEST(SvgScene, NamesWhatIsNotRead) {
  const auto problem = [](const std::string& elements) {
    const SvgScene scene = SceneOfElements(elements);
    EXPECT_EQ(scene.problems.size(), 1U) << elements;
    return scene.problems.empty() ? "" : scene.problems[0];
  };
  EXPECT_EQ(problem("\n<text>a</text><text>b</text>"), "a.svg:2: <text>: it is left out: it has no strokes");
  EXPECT_EQ(problem("<image href='a.png'/>"),
            "a.svg:1: <image>: it is left out: it is a picture. Export the picture itself as PNG");
  EXPECT_EQ(problem("<g mask='url(#m)'/>"), "a.svg:1: <g>: its mask is not applied");
  EXPECT_EQ(problem("<path d='M0 0H1' marker-end='url(#m)'/>"), "a.svg:1: <path>: its markers are not drawn");
  EXPECT_EQ(problem("<path d='M0 0H1 2x'/>"),
            "a.svg:1: <path>: position 8: 'x' is not a command of path data; it is drawn up to there");
  EXPECT_EQ(problem("<circle r='1' cx='NaN'/>"),
            "a.svg:1: <circle>: it is left out: position 0: 'NaN', expected a number");
  EXPECT_EQ(problem("<sketch/>"), "a.svg:1: <sketch>: it is left out: no element of this name is drawn");
  EXPECT_EQ(problem("<use href='b.svg#a'/>"), "a.svg:1: <use>: it is left out: 'b.svg#a' is no element of the file");
  EXPECT_EQ(problem("<g clip-path='circle(3px)'/>"), "a.svg:1: <g>: clip-path 'circle(3px)' is not applied");
  EXPECT_EQ(problem("<style>a:has(b){}</style>"), "a.svg:1: <svg>: the style sheet's 'a:has(b)' is not understood");
  EXPECT_EQ(problem("<path fill='ink' d=''/>"), "a.svg:1: <path>: fill 'ink' is not understood");
}

TEST(SvgScene, APolygonWithAnErrorIsClosed) {
  const SvgScene scene = SceneOfElements("<polygon points='0,0 9,0 9,9 3'/>");
  EXPECT_EQ(scene.shapes.at(0).polylines.at(0).points, (ScenePoints{{0, 0}, {9, 0}, {9, 9}, {0, 0}}));
}

}  // namespace
}  // namespace daumier::render
