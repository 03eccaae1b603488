#include "studio/hand_drawing.h"

#include "core/files.h"
#include "render/svg.h"
#include "tests/studio/pen_drawings.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

using testing::ExpectError;
using testing::PenDrawing;

TEST(HandDrawing, JsonGivesTheSameDrawing) {
  const HandDrawing drawing = PenDrawing("7", "face-00003");
  const HandDrawing read = HandDrawingFromJson(HandDrawingToJson(drawing), "x");
  EXPECT_EQ(read.person, "7");
  EXPECT_EQ(read.face, "face-00003");
  EXPECT_EQ(read.seconds, drawing.seconds);
  EXPECT_EQ(read.width, drawing.width);
  ASSERT_EQ(read.strokes.size(), drawing.strokes.size());
  for (size_t i = 0; i < read.strokes.size(); ++i) {
    EXPECT_EQ(read.strokes[i].points, drawing.strokes[i].points);
    EXPECT_EQ(read.strokes[i].times_ms, drawing.strokes[i].times_ms);
    EXPECT_EQ(read.strokes[i].pressures, drawing.strokes[i].pressures);
  }
}

TEST(HandDrawing, DamagedOnesAreRefusedWithTheCause) {
  const Json good = HandDrawingToJson(PenDrawing("1", "a"));
  const auto refused = [&](const char* place, const Json& value, const std::string& cause) {
    Json bad = good;
    bad[Json::json_pointer(place)] = value;
    ExpectError([&] { HandDrawingFromJson(bad, "drawing 3"); }, cause);
    ExpectError([&] { HandDrawingFromJson(bad, "drawing 3"); }, "drawing 3");
  };
  refused("/format_version", 2, "a drawing of version 2, expected 1");
  refused("/person", 3, "malformed");
  refused("/sheet", {100, 512}, "the sheet is 100 x 512");
  refused("/width", 0, "the pen is 0 wide");
  refused("/seconds", -1, "seconds is -1");
  refused("/strokes", Json::array(), "nothing is drawn");
  refused("/strokes/0/points/0", {2000, 0}, "at most a sheet of 512 pixels away");
  refused("/strokes/0/times_ms", {5, 4}, "not ascending");
  refused("/strokes/0/times_ms", {5}, "2 points, 1 times");
  refused("/strokes/0/pressures/0", 1.5, "a pressure of stroke 0");
  refused("/strokes/0/points/0/0", nullptr, "malformed");
}

TEST(HandDrawing, ComesToTheMiddleAndTheHeightOfTheExactCurves) {
  HandDrawing drawing = PenDrawing("1", "a");
  drawing.strokes = {{{{{100, 100}}, {{300, 500}}}, {0, 1}, {1, 1}}};
  const std::vector<render::Stroke> exact = {{0, {{100, 60}, {140, 60}}}, {0, {{100, 160}}}};
  const std::vector<render::Stroke> moved = OnCanvas(drawing, exact, 9);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].kind, 9);
  // A quarter of the size; the middle (200, 300) comes to (120, 110).
  EXPECT_EQ(moved[0].points[0], (std::array<float, 2>{95, 60}));
  EXPECT_EQ(moved[0].points[1], (std::array<float, 2>{145, 160}));
}

TEST(HandDrawing, SvgHasItsStrokesInPixelsOfTheSheet) {
  const testing::TempDir folder;
  const HandDrawing drawing = PenDrawing("1", "a");
  WriteSvg(folder / "a.svg", drawing);
  const render::Drawing read = render::ReadSvg(folder / "a.svg", {"drawn"});
  EXPECT_EQ(read.width, HandDrawing::kSheet);
  EXPECT_EQ(read.height, HandDrawing::kSheet);
  ASSERT_EQ(read.strokes.size(), drawing.strokes.size());
  for (size_t i = 0; i < read.strokes.size(); ++i) {
    ASSERT_EQ(read.strokes[i].points.size(), drawing.strokes[i].points.size());
    EXPECT_NEAR(read.strokes[i].points.back()[0], drawing.strokes[i].points.back()[0], 1e-3);
    EXPECT_NEAR(read.strokes[i].points.back()[1], drawing.strokes[i].points.back()[1], 1e-3);
  }
}

}  // namespace
}  // namespace daumier::studio
