#include "studio/sketch_state_json.h"

#include "tests/studio/plain_desk.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

using sketch::SketchState;

SketchState FollowUpState() {
  SketchState state;
  state.start = std::make_shared<const sketch::FollowUpStart>();
  state.frame = {.scale = 0.5, .shift = {10, 20}};
  state.vertices = geometry::Points::Zero(4, 3);
  return state;
}

/// Five points of a curve on the canvas, with x = 10, 20, ..., which the sheet of FollowUpState has at x = 0, 20, ....
sketch::SessionCurve StraightCurve(std::optional<sketch::CurveGap> gap = {}) {
  sketch::SessionCurve curve{.name = "nose", .kind = "nose", .points = {}, .gap = gap};
  for (int i = 0; i < 5; ++i) curve.points.emplace_back(10 + 10 * i, 20);
  return curve;
}

TEST(SketchStateJson, OfABlankSheetHasNoFace) {
  const Json json = SketchStateJson(SketchState());
  EXPECT_EQ(json["mode"], "draw");
  EXPECT_EQ(json["has_face"], false);
  for (const char* list : {"lines", "open_ends", "handles", "region", "warnings", "drawn_parts"})
    EXPECT_EQ(json[list], Json::array()) << list;
}

TEST(SketchStateJson, StrokesAreLinesInPixelsOfTheSheet) {
  SketchState state;
  state.vertices = geometry::Points::Zero(4, 3);
  state.warnings = {"the drawing is small"};
  state.strokes.resize(2);
  state.strokes[0].points = {{1.234f, 2}, {3, 4.567f}};
  state.strokes[1].points = {{5, 6}, {7, 8}};
  state.strokes[1].widths = {1.5f, 3.25f};
  const Json json = SketchStateJson(state);
  EXPECT_EQ(json["has_face"], true);
  EXPECT_EQ(json["warnings"], (Json{"the drawing is small"}));
  ASSERT_EQ(json["lines"].size(), 2u);
  EXPECT_EQ(json["lines"][0]["kind"], "stroke");
  EXPECT_EQ(json["lines"][0]["points"], Json::parse("[[1.23, 2.0], [3.0, 4.57]]"));
  EXPECT_EQ(json["lines"][0]["width"], 0) << "as wide as lines of the canvas";
  EXPECT_FALSE(json["lines"][0].contains("widths"));
  EXPECT_EQ(json["lines"][1]["width"], 3.25) << "the largest";
  EXPECT_EQ(json["lines"][1]["widths"], Json::parse("[1.5, 3.25]"));
}

TEST(SketchStateJson, ReachesAreThoseOfTheSheet) {
  const Json json = SketchStateJson(FollowUpState());
  EXPECT_EQ(json["mode"], "follow_up");
  EXPECT_EQ(json["snap_reach"], 2 * sketch::kSnapReach);
  EXPECT_EQ(json["eraser_reach"], 2 * sketch::kEraserReach);
}

TEST(SketchStateJson, CurvesComeBeforeWrinkles) {
  SketchState state = FollowUpState();
  state.lines.curves = {StraightCurve()};
  state.lines.wrinkles.resize(1);
  state.lines.wrinkles[0].points = {{10, 20}, {15, 20}};
  const Json lines = SketchStateJson(state)["lines"];
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["kind"], "curve");
  EXPECT_EQ(lines[0]["points"][1], Json::parse("[20.0, 0.0]"));
  EXPECT_EQ(lines[1]["kind"], "wrinkle");
  EXPECT_EQ(lines[1]["points"], Json::parse("[[0.0, 0.0], [10.0, 0.0]]"));
}

TEST(SketchStateJson, OpenEndsAreThePointsNextToAGap) {
  SketchState state = FollowUpState();
  state.lines.curves = {StraightCurve(), StraightCurve(sketch::CurveGap{1, 2})};
  EXPECT_EQ(SketchStateJson(state)["open_ends"], Json::parse("[[[0.0, 0.0], [60.0, 0.0]]]"));
}

TEST(SketchStateJson, ACurveThatLacksAnEndIsFilledToWhereItWas) {
  SketchState state = FollowUpState();
  sketch::SessionCurve curve = StraightCurve(sketch::CurveGap{0, 1});
  state.lines.curves = {curve};
  EXPECT_EQ(SketchStateJson(state)["open_ends"], Json::parse("[[[0.0, 0.0], [40.0, 0.0]]]"));
  state.lines.curves[0].gap = sketch::CurveGap{3, 4};
  EXPECT_EQ(SketchStateJson(state)["open_ends"], Json::parse("[[[40.0, 0.0], [80.0, 0.0]]]"));
}

TEST(SketchStateJson, AClosedCurveThatIsErasedWholeHasNoEnds) {
  SketchState state = FollowUpState();
  state.lines.curves = {StraightCurve(sketch::CurveGap{0, 4})};
  state.lines.curves[0].closed = true;
  EXPECT_EQ(SketchStateJson(state)["open_ends"], Json::array());
}

TEST(SketchStateJson, OfRefinementHasHandlesAndTheRegion) {
  sketch::SketchSession session(testing::PlainSketchPredictor(), 256, 256);
  session.Refine();
  Json json = SketchStateJson(*session.state());
  EXPECT_EQ(json["mode"], "refine");
  EXPECT_EQ(json["region"], Json::array()) << "the whole mesh";
  EXPECT_EQ(json["handles"], Json::array());
  EXPECT_FALSE(json["lines"].empty());
  const geometry::Points seen = render::Project(session.CameraOf(*session.state(), {}), session.state()->vertices);
  const Eigen::Vector2d middle =
      (seen.leftCols<2>().colwise().minCoeff() + seen.leftCols<2>().colwise().maxCoeff()) / 2;
  using What = sketch::RefinementOperation::What;
  session.Apply({.what = What::kBrush, .points = {middle}, .radius = 20});
  json = SketchStateJson(*session.state());
  EXPECT_FALSE(json["handles"].empty());
  EXPECT_EQ(json["handles"], Json(session.state()->refinement->handles));
  sketch::CanvasPoints loop;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * 3.14159265 * i / 41;
    loop.push_back(middle + 60 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  session.Apply({.what = What::kRegion, .points = loop});
  json = SketchStateJson(*session.state());
  EXPECT_FALSE(json["region"].empty());
  EXPECT_EQ(json["region"], Json(session.state()->refinement->region->deformation.region()));
}

}  // namespace
}  // namespace daumier::studio
