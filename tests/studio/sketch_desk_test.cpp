#include "studio/sketch_desk.h"

#include "studio/api.h"
#include "tests/studio/sketch_desk_fixture.h"
#include "tests/support/expect_error.h"

#include <chrono>
#include <ctime>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::WrinkleEvent;

/// Always recognises the same gesture.
class OneGestureNetwork : public runtime::NetworkRunner {
 public:
  explicit OneGestureNetwork(datasets::Gesture gesture) : gesture_(gesture) {}
  NamedArrays Run(const NamedArrays&) const override {
    FloatArray scores({1, sketch::kNumGestureClasses});
    scores.values.assign(scores.values.size(), 0.0f);
    scores.values[size_t(gesture_)] = 20;
    return {{"scores", scores}};
  }

 private:
  datasets::Gesture gesture_;
};

TEST_F(SketchDeskTest, ANewSessionIsABlankSheet) {
  SketchDesk desk = OpenDesk();
  EXPECT_EQ(desk.List(), Json::array());
  EXPECT_EQ(desk.Add({.name = "Ada\n"}), "s-0001");
  const Json state = desk.State("s-0001");
  EXPECT_EQ(state["id"], "s-0001");
  EXPECT_EQ(state["name"], "Ada");
  EXPECT_EQ(state["revision"], 0);
  EXPECT_EQ(state["sheet"], (Json{SketchDesk::kSheet, SketchDesk::kSheet}));
  EXPECT_EQ(state["mode"], "draw");
  EXPECT_EQ(state["has_face"], false);
  EXPECT_EQ(state["can_undo"], false);
  EXPECT_EQ(state["can_redo"], false);
  EXPECT_EQ(desk.Face("s-0001").rows(), 0);
  EXPECT_TRUE(desk.DrawnStrokes("s-0001").empty());
  EXPECT_EQ(desk.List()[0]["events"], 0);
  ExpectError([&] { desk.FileOf("s-0001"); }, "nothing has been drawn");
  EXPECT_EQ(desk.State(desk.Add({}))["name"], "Untitled");
}

TEST_F(SketchDeskTest, EachEventIsInTheFileAsARecordedSession) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({});
  const Json event = testing::DrawEvent({{20, 100}, {220.5, 100}});
  const Json state = desk.Do(id, event);
  EXPECT_EQ(state["changed"], true);
  EXPECT_EQ(state["revision"], 1);
  EXPECT_EQ(state["can_undo"], true);
  EXPECT_GE(state["milliseconds"], 0);
  EXPECT_FALSE(state.contains("gesture"));
  EXPECT_EQ(WithoutEvent(state), desk.State(id));
  const sketch::SessionScript script = sketch::ReadSession(desk.FileOf(id));
  EXPECT_EQ(script.width, SketchDesk::kSheet);
  ASSERT_EQ(script.events.size(), 1u);
  EXPECT_EQ(script.events[0].points, (sketch::CanvasPoints{{20, 100}, {220.5, 100}}));
  EXPECT_EQ(desk.List()[0]["events"], 1);
  EXPECT_EQ(desk.DrawnStrokes(id).size(), 1u);
}

TEST_F(SketchDeskTest, AnEventWithNothingToActOnIsNotWritten) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({});
  desk.Do(id, WrinkleEvent());
  const std::string bytes = Bytes(id);
  for (const Json& event : {Json{{"do", "erase"}, {"points", {{500, 500}}}}, EventOf("redo")}) {
    const Json state = desk.Do(id, event);
    EXPECT_EQ(state["changed"], false) << event;
    EXPECT_EQ(state["revision"], 1);
    EXPECT_EQ(Bytes(id), bytes);
  }
}

TEST_F(SketchDeskTest, AnEventThatThrowsChangesNothing) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.begins_with_mean = true});
  desk.Do(id, WrinkleEvent());
  const std::string bytes = Bytes(id);
  const Json state = desk.State(id);
  const auto refused = [&](const Json& event, const char* why) {
    ExpectError([&] { desk.Do(id, event); }, why);
    EXPECT_EQ(Bytes(id), bytes) << event;
    EXPECT_EQ(desk.State(id), state) << event;
  };
  refused(Json(), "no text 'do'");
  refused({{"do", "paint"}}, "\"paint\" is unknown");
  refused({{"do", "draw"}}, "'draw' has no 'points'");
  refused(testing::DrawEvent({{1, 1}}), "shorter than a pixel");
  refused(testing::DrawEvent({{1, 1}, {1e9, 1}}), "lies far outside the sheet");
  refused({{"do", "draw"}, {"points", {{1, 1}, {9, 9}}}, {"wieght", 3}}, "'draw' takes no 'wieght'");
  refused({{"do", "roll"}, {"level", 1}}, "refinement has not begun");
  refused({{"do", "gesture"}, {"points", {{1, 1}, {90, 9}}}}, "");
  EXPECT_EQ(OpenDesk().State(id), state);
}

TEST_F(SketchDeskTest, ANewNameIsKept) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.name = "Ada"});
  desk.Rename(id, " Zoë\t\x01 ");
  EXPECT_EQ(desk.State(id)["name"], "Zoë");
  EXPECT_EQ(desk.List()[0]["name"], "Zoë");
  desk.Do(id, WrinkleEvent());
  EXPECT_EQ(OpenDesk().State(id)["name"], "Zoë");
  desk.Rename(id, "");
  EXPECT_EQ(OpenDesk().List()[0]["name"], "Untitled");
  EXPECT_EQ(OpenDesk().State(id)["revision"], 1) << "a name is no event";
}

TEST_F(SketchDeskTest, TheLastChangedComesFirst) {
  SketchDesk desk = OpenDesk();
  const std::string first = desk.Add({}), second = desk.Add({}), third = desk.Add({});
  desk.Do(first, WrinkleEvent());
  desk.Do(third, WrinkleEvent());
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(folder_ / first / "session.json", now - std::chrono::seconds(100));
  fs::last_write_time(folder_ / second / "about.json", now - std::chrono::seconds(50));
  fs::last_write_time(folder_ / third / "session.json", now - std::chrono::seconds(200));
  const Json list = desk.List();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0]["id"], second);
  EXPECT_EQ(list[1]["id"], first);
  EXPECT_EQ(list[2]["id"], third);
  EXPECT_EQ(list[0]["changed"].get<int64_t>() - list[1]["changed"].get<int64_t>(), 50);
  EXPECT_LE(std::abs(list[0]["changed"].get<int64_t>() + 50 - std::time(nullptr)), 5) << "since 1970";
}

TEST_F(SketchDeskTest, ARemovedSessionIsGoneAndItsIdIsNotUsedAgain) {
  SketchDesk desk = OpenDesk();
  desk.Add({});
  const std::string id = desk.Add({});
  desk.Do(id, WrinkleEvent());
  desk.Remove(id);
  EXPECT_FALSE(fs::exists(folder_ / id));
  EXPECT_FALSE(desk.Has(id));
  EXPECT_EQ(desk.Add({}), "s-0003");
  for (const char* name : {"s-0002", "", "..", "../s-0001", "s-0001/..", "f-0001", "s-0001/session.json", "s-9999"}) {
    EXPECT_FALSE(desk.Has(name)) << name;
    EXPECT_THROW(desk.State(name), NotFound) << name;
    EXPECT_THROW(desk.Do(name, WrinkleEvent()), NotFound) << name;
    EXPECT_THROW(desk.Face(name), NotFound) << name;
    EXPECT_THROW(desk.DrawnStrokes(name), NotFound) << name;
    EXPECT_THROW(desk.Preview(name, {.points = {{1, 1}, {9, 9}}}), NotFound) << name;
    EXPECT_THROW(desk.PixelFromCm(name, {}), NotFound) << name;
    EXPECT_THROW(desk.FileOf(name), NotFound) << name;
    EXPECT_THROW(desk.Rename(name, "x"), NotFound) << name;
    EXPECT_THROW(desk.Remove(name), NotFound) << name;
  }
}

TEST_F(SketchDeskTest, APreviewChangesNothing) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({});
  desk.Do(id, testing::FaceEvents().front());
  const Json state = desk.State(id);
  EXPECT_EQ(desk.Preview(id, {.points = {{20, 20}, {200, 90}}}).rows(), Neutral().rows());
  EXPECT_EQ(desk.State(id), state);
  ExpectError([&] { desk.Preview(id, {.points = {{20, 20}}}); }, "shorter than a pixel");
  ExpectError([&] { desk.Preview(id, {}); }, "");
  ExpectError([&] { desk.Preview(id, {.what = sketch::SessionEvent::What::kUndo}); }, "'undo' has no preview");
}

TEST_F(SketchDeskTest, APreviewOfAnOperationIsTheFaceThatItMakes) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.begins_with_mean = true});
  const Json translate = {{"do", "translate"}, {"points", {{250, 250}, {270, 240}}}};
  const sketch::SessionEvent event = sketch::EventFromJson(translate);
  ExpectError([&] { desk.Preview(id, event); }, "refinement has not begun");
  desk.Do(id, EventOf("refine"));
  desk.Do(id, {{"do", "brush"}, {"points", {{250, 250}, {256, 250}}}, {"radius", 20}});
  const Json state = desk.State(id);
  const geometry::Points before = desk.Face(id), preview = desk.Preview(id, event);
  EXPECT_EQ(desk.State(id), state);
  EXPECT_EQ(desk.Face(id), before);
  EXPECT_NE(preview, before);
  const SketchDesk::SeenState seen = desk.DoAndSee(id, translate);
  EXPECT_EQ(seen.face, preview);
  EXPECT_EQ(seen.face, desk.Face(id));
  EXPECT_EQ(seen.state["revision"], desk.State(id)["revision"]);
}

TEST_F(SketchDeskTest, StrokesAreThoseOfInitialModeAlone) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({});
  for (const Json& event : testing::FaceEvents()) desk.Do(id, event);
  EXPECT_EQ(desk.DrawnStrokes(id).size(), testing::FaceEvents().size());
  desk.Do(id, EventOf("follow_up"));
  EXPECT_TRUE(desk.DrawnStrokes(id).empty());
}

TEST_F(SketchDeskTest, TheCameraPutsVerticesWhereTheSheetShowsThem) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.begins_with_mean = true});
  sketch::SketchSession session(testing::PlainSketchPredictor(), SketchDesk::kSheet, SketchDesk::kSheet);
  session.FollowUp();
  const geometry::Points face = desk.Face(id);
  for (const sketch::View view : {sketch::View{}, sketch::View{30, -10}}) {
    const Eigen::Matrix<double, 3, 4> matrix = desk.PixelFromCm(id, view);
    const geometry::Points seen = render::Project(session.CameraOf(*session.state(), view), face);
    const geometry::Points found = (face * matrix.leftCols<3>().transpose()).rowwise() + matrix.col(3).transpose();
    EXPECT_LT((found - seen).cwiseAbs().maxCoeff(), 1e-9) << view.yaw_degrees;
  }
}

TEST_F(SketchDeskTest, AGestureIsReportedByItsName) {
  sketch::GestureDecision decision;
  decision.rejection.threshold = 0.5;
  const auto gestures = std::make_shared<const sketch::GestureRecogniser>(
      decision, std::make_shared<OneGestureNetwork>(datasets::Gesture::kLeftArrow));
  SketchDesk desk(folder_.path(), testing::PlainSketchPredictor(), gestures);
  const std::string id = desk.Add({});
  desk.Do(id, EventOf("refine"));
  const Json state = desk.Do(id, {{"do", "gesture"}, {"points", {{100, 100}, {200, 110}}}});
  EXPECT_EQ(state["gesture"], datasets::NameOf(datasets::Gesture::kLeftArrow));
  EXPECT_EQ(state["mode"], "draw") << "a left arrow undoes";
  EXPECT_EQ(SketchDesk(folder_.path(), testing::PlainSketchPredictor(), gestures).State(id), desk.State(id));
}

}  // namespace
}  // namespace daumier::studio
