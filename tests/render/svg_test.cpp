#include "render/svg.h"

#include "core/files.h"
#include "core/log.h"
#include "core/random.h"
#include "tests/render/gzipped.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

using testing::ExpectError;
using Points = std::vector<std::array<float, 2>>;

const std::vector<std::string> kKinds = {"outline", "upper_edge", "a&b\"<c>"};

class Svg : public ::testing::Test {
 protected:
  Drawing Read(const std::string& text, const std::vector<std::string>& kinds = {}) {
    testing::WriteQuickly(path_, text);
    return ReadSvg(path_, kinds);
  }
  /// Of a sheet of 256 x 256.
  Drawing ReadElements(const std::string& elements, const std::vector<std::string>& kinds = {}) {
    return Read("<svg xmlns='http://www.w3.org/2000/svg' width='256' height='256'>\n" + elements + "\n</svg>", kinds);
  }
  Points ReadOne(const std::string& element) {
    const auto drawing = ReadElements(element);
    EXPECT_EQ(drawing.strokes.size(), 1U) << element;
    return drawing.strokes[0].points;
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "drawing.svg";
};

std::vector<Stroke> RandomStrokes() {
  Rng rng(3);
  std::vector<Stroke> strokes;
  for (int s = 0; s < 40; ++s) {
    Stroke stroke{.kind = s % 3, .points = {}};
    for (int p = 0; p < 1 + s; ++p) {
      stroke.points.push_back({static_cast<float>(rng.Uniform(-20, 280)), static_cast<float>(rng.Uniform(0, 1e-3))});
    }
    strokes.push_back(stroke);
  }
  return strokes;
}

TEST_F(Svg, RoundTripIsExactWithKinds) {
  const auto strokes = RandomStrokes();
  WriteSvg(path_, strokes, kKinds);
  const Drawing drawing = ReadSvg(path_, kKinds);
  EXPECT_EQ(drawing.width, 256.0);
  EXPECT_EQ(drawing.height, 256.0);
  ASSERT_EQ(drawing.strokes.size(), strokes.size());
  for (size_t s = 0; s < strokes.size(); ++s) {
    EXPECT_EQ(drawing.strokes[s].kind, strokes[s].kind);
    EXPECT_EQ(drawing.strokes[s].points, strokes[s].points);
  }
}

TEST_F(Svg, DotsComeBackAndEmptyStrokesAreLeftOut) {
  WriteSvg(path_, {{1, {{3, 4}}}, {0, {}}, {2, {{5, 6}, {5, 6}}}}, kKinds);
  const Drawing drawing = ReadSvg(path_, kKinds);
  ASSERT_EQ(drawing.strokes.size(), 2U);
  EXPECT_EQ(drawing.strokes[0].points, (Points{{3, 4}}));
  EXPECT_EQ(drawing.strokes[1].points, (Points{{5, 6}}));
}

TEST_F(Svg, RefusesToWriteWhatCannotBeRead) {
  ExpectError([&] { WriteSvg(path_, {{3, {{1, 2}}}}, kKinds); }, "kind 3, but there are 3 names");
  ExpectError([&] { WriteSvg(path_, {}, {"two words"}); }, "'two words'");
  const float infinity = std::numeric_limits<float>::infinity();
  ExpectError([&] { WriteSvg(path_, {{0, {{1, infinity}}}}, kKinds); }, "(1, inf)");
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(Svg, ShapesAreWorkedOutByHand) {
  EXPECT_EQ(ReadOne("<path stroke='red' d='M1 2L3 4'/>"), (Points{{1, 2}, {3, 4}}));
  EXPECT_EQ(ReadOne("<line stroke='red' x1='1' y1='2' x2='3'/>"), (Points{{1, 2}, {3, 0}}));
  EXPECT_EQ(ReadOne("<polyline points='1,2 3,4 5,6'/>"), (Points{{1, 2}, {3, 4}, {5, 6}}));
  EXPECT_EQ(ReadOne("<polygon points='1,2 3,4 5,6'/>"), (Points{{1, 2}, {3, 4}, {5, 6}, {1, 2}}));
  EXPECT_EQ(ReadOne("<rect x='1' y='2' width='10' height='20'/>"),
            (Points{{1, 2}, {11, 2}, {11, 22}, {1, 22}, {1, 2}}));
  for (const auto& [x, y] : ReadOne("<circle cx='50' cy='60' r='20'/>")) {
    EXPECT_NEAR(std::hypot(x - 50, y - 60), 20.0, 1e-4);
  }
  for (const auto& [x, y] : ReadOne("<ellipse cx='50' cy='60' rx='20' ry='10'/>")) {
    EXPECT_NEAR(std::hypot((x - 50) / 20, (y - 60) / 10), 1.0, 1e-5);
  }
  const auto rounded = ReadOne("<rect x='10' y='10' width='40' height='20' rx='5'/>");
  EXPECT_EQ(rounded.front(), (std::array<float, 2>{15, 10}));
  EXPECT_EQ(rounded.back(), rounded.front());
  for (const auto& [x, y] : rounded) EXPECT_FALSE(x < 11 && y < 11) << "the corner is cut";
}

TEST_F(Svg, TransformsOfGroupsNest) {
  EXPECT_EQ(ReadOne("<g transform='translate(10 20)'><g transform='scale(2)'>"
                    "<line stroke='red' x2='3' y2='4' transform='translate(1)'/></g></g>"),
            (Points{{12, 20}, {18, 28}}));
}

TEST_F(Svg, CurvesAreFineWhereTheyAreMadeLarger) {
  for (const auto& [x, y] : ReadOne("<g transform='scale(100)'><circle cx='1' cy='1' r='1'/></g>")) {
    EXPECT_NEAR(std::hypot(x - 100, y - 100), 100.0, 1e-3);
  }
  EXPECT_GT(ReadOne("<g transform='scale(100)'><circle cx='1' cy='1' r='1'/></g>").size(), 60U);
  EXPECT_LT(ReadOne("<circle cx='1' cy='1' r='1'/>").size(), 16U);
}

TEST_F(Svg, ViewBoxIsFittedIntoTheSheet) {
  const auto fitted = Read("<svg width='100' height='200' viewBox='-5 0 10 10'><path d='M0 0H1'/></svg>");
  EXPECT_EQ(fitted.width, 100.0);
  EXPECT_EQ(fitted.height, 200.0);
  EXPECT_EQ(fitted.strokes[0].points, (Points{{50, 50}, {60, 50}}));
  const auto stretched =
      Read("<svg width='100' height='200' viewBox='0 0 10 10' preserveAspectRatio='none'><path d='M1 1H2'/></svg>");
  EXPECT_EQ(stretched.strokes[0].points, (Points{{10, 20}, {20, 20}}));
}

TEST_F(Svg, SizeComesFromTheFile) {
  const auto box_alone = Read("<svg viewBox='0 0 30 40' width='100%'><path d='M0 0H1'/></svg>");
  EXPECT_EQ(box_alone.width, 30.0);
  EXPECT_EQ(box_alone.height, 40.0);
  const auto width_and_box = Read("<svg viewBox='0 0 30 40' width='60px'><path d='M0 0H1'/></svg>");
  EXPECT_EQ(width_and_box.height, 80.0);
  const auto inches = Read("<svg width='1in' height='25.4mm'><path d='M0 0H1'/></svg>");
  EXPECT_EQ(inches.width, 96.0);
  EXPECT_NEAR(inches.height, 96.0, 1e-9);
  const auto nothing = Read("<svg><path d='M0 0L70 50'/></svg>");
  EXPECT_EQ(nothing.width, 70.0);
  EXPECT_EQ(nothing.height, 50.0);
}

TEST_F(Svg, LeavesOutWhatIsNotShown) {
  const std::string shown = "<path id='shown' d='M1 1H2'/>";
  for (const std::string hidden :
       {"<g display='none'><path d='M0 0H9'/></g>", "<path style='opacity: 0; display:none' d='M0 0H9'/>",
        "<path opacity='0' d='M0 0H9'/>", "<g visibility='hidden'><path d='M0 0H9'/></g>",
        "<path fill='none' d='M0 0H9'/>", "<defs><path d='M0 0H9'/></defs>", "<clipPath><path d='M0 0H9'/></clipPath>",
        "<path fill='#FFF' d='M0 0H9V9'/>", "<path style='fill: white; stroke: none' d='M0 0H9V9'/>",
        "<rect width='256' height='256' fill='#eee'/>",
        "<path style='stroke:black;stroke-opacity:0;fill:none' d='M0 0H9'/>", "<!-- <path d='M0 0H9'/> -->"}) {
    EXPECT_EQ(ReadElements(hidden + shown).strokes.size(), 1U) << hidden;
  }
  EXPECT_EQ(ReadElements("<g visibility='hidden'><path visibility='visible' d='M0 0H9'/></g>").strokes.size(), 1U);
  EXPECT_EQ(ReadElements("<rect width='256' height='256' fill='#eee' stroke='black'/>").strokes.size(), 1U);
}

TEST_F(Svg, KindIsTheFirstKnownWordOfTheClass) {
  const auto drawing = ReadElements(
      "<path class='thin upper_edge outline' d='M0 0H1'/><g class='upper_edge'><path class='thin' d='M0 0H1'/></g>"
      "<path class='thin' d='M0 0H1'/>",
      kKinds);
  EXPECT_EQ(drawing.strokes[0].kind, 1);
  EXPECT_EQ(drawing.strokes[1].kind, 1);
  EXPECT_EQ(drawing.strokes[2].kind, 0);
}

TEST_F(Svg, ErrorsSayFileElementAndPosition) {
  ExpectError([&] { ReadElements("<path d='M1 L2 3'/>"); }, "drawing.svg: the drawing holds no strokes. ");
  ExpectError([&] { ReadElements("<path d='M1 L2 3'/>"); }, "drawing.svg:2: <path>: position 3");
  ExpectError([&] { ReadElements("<polygon points='1'/>"); }, "drawing.svg:2: <polygon>");
  ExpectError([&] { ReadElements("<g>\n<g transform='spin(3)'/></g>"); },
              "drawing.svg:3: <g>: it is left out: there is no transform");
  ExpectError([&] { ReadElements("<circle r='big'/>"); }, "<circle>: it is left out: position 0");
  ExpectError([&] { ReadElements("<rect width='3 furlongs'/>"); }, "is not a length");
  ExpectError([&] { ReadElements("<path transform='scale(1e300)' d='M0 0L1 1'/>"); }, "a point lies at");
  ExpectError([&] { ReadElements("<image href='a.png'/>"); }, "Export the picture itself as PNG");
  ExpectError([&] { ReadElements(""); }, "drawing.svg: the drawing holds no strokes");
  ExpectError([&] { Read("<html/>"); }, "the outermost element is <html>");
  ExpectError([&] { Read("<svg width='-3'/>"); }, "drawing.svg:1: <svg>: width and height must be positive");
  ExpectError([&] { Read("<svg viewBox='0 0 3'/>"); }, "<svg>: position 5");
  ExpectError([&] { Read("no drawing"); }, "not XML");
  ExpectError([&] { ReadSvg(folder_ / "absent.svg"); }, "absent.svg");
  std::string nested;
  for (int i = 0; i < 5000; ++i) nested += "<g>";
  for (int i = 0; i < 5000; ++i) nested += "</g>";
  ExpectError([&] { ReadElements(nested); }, "nested more than");
}

TEST_F(Svg, WarnsOfWhatItLeavesOut) {
  testing::AllowWarnings();
  const int before = log::NumWarnings();
  EXPECT_EQ(ReadElements("<path stroke='red' d='M1 1H2 3QNaN NaN 4 4Z'/><text>word</text><circle r='NaN'/>")
                .strokes[0]
                .points,
            (Points{{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_EQ(log::NumWarnings() - before, 3);
  std::string many;
  for (int i = 0; i < 30; ++i) many += fmt::format("<text{}/>", i);
  ReadElements("<path d='M1 1H2'/>" + many);
  EXPECT_EQ(log::NumWarnings() - before, 3 + 11);
}

TEST_F(Svg, CompressedFilesAreRead) {
  const std::string text = "<svg width='9' height='9'><path d='M1 1H2'/></svg>";
  EXPECT_EQ(Read(testing::Gzipped(text)).strokes[0].points, Read(text).strokes[0].points);
}

TEST_F(Svg, ExportersFormsOfOneDrawingAgree) {
  const std::string ns = "xmlns='http://www.w3.org/2000/svg' ", size = "width='256' height='256' viewBox='0 0 256 256'";
  const std::string paths = "<path d='M40 90C40 210 90 236 128 236'/><path d='M70 84Q90 74 108 84'/>";
  const std::string plain = "<g fill='none' stroke='black'>" + paths + "</g>";
  const Drawing expected = Read("<svg " + ns + size + ">" + plain + "</svg>");
  ASSERT_EQ(expected.strokes.size(), 2U);
  for (const std::string& svg :
       {"<svg " + size +
            "><style>.a{fill:none;stroke:#231F20}.b{display:none}</style><g class='b'><path class='a' "
            "d='M-9 0L300 256'/></g><g class='a'>" +
            paths + "</g></svg>",
        "<svg viewBox='0 0 256 256'><symbol id='s' viewBox='0 0 256 256'>" + plain +
            "</symbol><use href='#s' "
            "width='256' height='256'/></svg>",
        "<svg " + size + "><defs>" + plain.substr(0, 2) + " id='d'" + plain.substr(2) +
            "</defs><use xlink:href='#d'/></svg>",
        "<svg " + size + "><svg x='64' y='64' width='128' height='128' viewBox='64 64 128 128' overflow='visible'>" +
            plain + "</svg></svg>",
        "<svg " + ns + size + "><rect width='100%' height='100%' fill='white'/>" + plain +
            "<path d='M0 0H256' stroke='#ffffff' stroke-width='30'/></svg>",
        "<svg " + size + "><clipPath id='c'><rect width='256' height='256'/></clipPath><g clip-path='url(#c)'>" +
            plain + "<path stroke='black' d='M300 0V256'/></g></svg>",
        "<svg width='100%' height='100%' viewBox='0 0 256 256'><switch><foreignObject requiredExtensions='x'/>" +
            plain + "</switch></svg>"}) {
    const Drawing drawing = Read(svg);
    EXPECT_EQ(drawing.width, 256.0) << svg;
    ASSERT_EQ(drawing.strokes.size(), 2U) << svg;
    for (size_t s = 0; s < 2; ++s) {
      const auto &found = drawing.strokes[s].points, &wanted = expected.strokes[s].points;
      ASSERT_EQ(found.size(), wanted.size()) << svg;
      for (size_t p = 0; p < found.size(); ++p)
        EXPECT_LT(std::hypot(found[p][0] - wanted[p][0], found[p][1] - wanted[p][1]), 1e-3) << svg;
    }
  }
}

TEST_F(Svg, RefusesTruncatedFiles) {
  WriteSvg(path_, {{0, {{1, 2}, {3, 4}}}, {1, {{5, 6}, {7, 8}}}}, kKinds);
  const std::string bytes = ReadFile(path_);
  const auto read = [&] { ReadSvg(path_, kKinds); };
  // The file ends with a line feed, without which it is still whole.
  EXPECT_EQ(testing::CountRefusedTruncations(path_, bytes, read), static_cast<int>(bytes.size()) - 1);
}

TEST_F(Svg, SurvivesDamagedFiles) {
  testing::AllowWarnings();
  WriteSvg(path_, {{0, {{1, 2}, {3, 4}}}, {1, {{5, 6}, {7, 8}}}}, kKinds);
  Rng rng(5);
  EXPECT_GT(testing::CountRefusedFlips(path_, ReadFile(path_), 500, rng, [&] { ReadSvg(path_, kKinds); }), 100);
}

}  // namespace
}  // namespace daumier::render
