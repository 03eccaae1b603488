#include "systems/sketch/session_file.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

class SessionFileTest : public ::testing::Test {
 protected:
  SessionScript Read(const std::string& text) const {
    WriteFileAtomically(folder_ / "session.json", text);
    return ReadSession(folder_ / "session.json");
  }
  /// A session of these events.
  SessionScript ReadEvents(const std::string& events) const {
    return Read(R"({"version": 1, "sheet": [256, 200], "events": [)" + events + "]}");
  }

  const testing::TempDir folder_;
};

TEST_F(SessionFileTest, WritingAndReadingGivesTheSameSession) {
  SessionScript script{300, 200, {}};
  using enum SessionEvent::What;
  using Operation = RefinementOperation;
  script.begin = "face.obj";
  script.events = {{.what = kDraw, .points = {{1, 2.5}, {3, 4}}, .pen = {true, 12.5}},
                   {.what = kDraw, .points = {{1, 2.5}, {3, 4}}, .pen = {.weight = 3.25, .pressure = {0.5, 1}}},
                   {.what = kErase, .points = {{7, 8}}, .pen = {true}},
                   {.what = kFollowUp},
                   {.what = kUndo},
                   {.what = kRedo},
                   {.what = kRefine},
                   {.what = kGesture, .points = {{7, 8}, {9, 9}}, .operation = {.view = {-90, 10}}}};
  for (const Operation::What what : {Operation::What::kRegion, Operation::What::kTranslate, Operation::What::kPull})
    script.events.push_back({.what = kOperation, .operation = {what, {{1, 2}, {3, 4}}, {30, 0}}});
  for (const Operation::What what : {Operation::What::kBrush, Operation::What::kUnbrush})
    script.events.push_back({.what = kOperation, .operation = {what, {{1, 2}}, {}, 7.5}});
  script.events.push_back({.what = kOperation, .operation = {Operation::What::kRoll, {}, {0, -5}, 0, -2}});
  const SessionScript read = Read(SessionToJson(script).dump());
  EXPECT_EQ(read.width, 300);
  EXPECT_EQ(read.height, 200);
  EXPECT_EQ(read.begin, "face.obj");
  ASSERT_EQ(read.events.size(), script.events.size());
  for (size_t i = 0; i < read.events.size(); ++i) {
    const SessionEvent &a = read.events[i], &b = script.events[i];
    SCOPED_TRACE(NameOf(b));
    EXPECT_EQ(NameOf(a), NameOf(b));
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.pen.mirror, b.pen.mirror);
    EXPECT_EQ(a.pen.stabiliser, b.pen.stabiliser);
    EXPECT_EQ(a.pen.weight, b.pen.weight);
    EXPECT_EQ(a.pen.pressure, b.pen.pressure);
    EXPECT_EQ(a.operation.points, b.operation.points);
    EXPECT_EQ(a.operation.view.yaw_degrees, b.operation.view.yaw_degrees);
    EXPECT_EQ(a.operation.view.pitch_degrees, b.operation.view.pitch_degrees);
    EXPECT_EQ(a.operation.radius, b.operation.radius);
    EXPECT_EQ(a.operation.level, b.operation.level);
  }
}

TEST_F(SessionFileTest, AMalformedEventIsNamedByItsNumber) {
  const std::string good = R"({"do": "draw", "points": [[1, 2], [3, 4]]}, )";
  const auto refused = [&](const std::string& event, const std::string& why) {
    ExpectError([&] { ReadEvents(good + event); }, "event 2: " + why);
    ExpectError([&] { ReadEvents(good + event); }, "session.json");
  };
  refused("3", "it has no text 'do'");
  refused(R"({"do": "paint"})", "\"paint\" is unknown (expected draw, erase");
  refused(R"({"do": "draw"})", "'draw' has no 'points'");
  refused(R"({"do": "draw", "points": []})", "'points' is []");
  refused(R"({"do": "undo", "points": [[1, 2]]})", "'undo' takes no 'points'");
  refused(R"({"do": "draw", "points": 7})", "'points' is 7");
  refused(R"({"do": "draw", "points": [[1, 2]], "mirror": 1})", "'mirror' is 1");
  refused(R"({"do": "draw", "points": [[1, 2]], "stabiliser": "a"})", "\"a\" is no number");
  refused(R"({"do": "draw", "points": [[1, 2]], "weight": 0})", "'weight' is 0");
  refused(R"({"do": "draw", "points": [[1, 2]], "weight": "a"})", "\"a\" is no number");
  refused(R"({"do": "draw", "points": [[1, 2]], "pressure": [1]})", "the pressure of a pen without a weight");
  refused(R"({"do": "draw", "points": [[1, 2]], "weight": 2, "pressure": []})", "'pressure' is []");
  refused(R"({"do": "draw", "points": [[1, 2]], "weight": 2, "pressure": [1, 1]})", "the pressure at 2 points of 1");
  refused(R"({"do": "draw", "points": [[1, 2]], "weight": 2, "pressure": [2]})", "a pressure of 2");
  refused(R"({"do": "erase", "points": [[1, 2]], "weight": 2})", "'erase' takes no 'weight'");
  refused(R"({"do": "brush", "points": [[1, 2]]})", "'brush' has no 'radius'");
  refused(R"({"do": "region", "points": [[1, 2]], "view": [3]})", "[3] is no pair");
  refused(R"({"do": "region", "points": [[1, 2]], "view": [0, 1e9]})", "'view' is [0,");
  refused(R"({"do": "roll", "level": 0})", "'level' is 0");
  refused(R"({"do": "roll", "level": 1.5})", "'level' is 1.5");
  refused(R"({"do": "draw", "points": [[1]]})", "[1] is no pair [x, y]");
  refused(R"({"do": "draw", "points": [[1, "a"]]})", "\"a\" is no number");
}

TEST(SessionEventJson, OfEveryKindIsReadAsItIsWritten) {
  for (
      const char* text :
      {R"({"do":"draw","points":[[1.5,2.0],[3.0,4.0]]})",
       R"({"do":"draw","points":[[1.5,2.0],[3.0,4.0]],"mirror":true,"stabiliser":12.5,"weight":3.0,"pressure":[0.5,1.0]})",
       R"({"do":"erase","points":[[1.0,2.0]],"mirror":true})", R"({"do":"follow_up"})", R"({"do":"refine"})",
       R"({"do":"undo"})", R"({"do":"redo"})", R"({"do":"region","points":[[1.0,2.0],[3.0,4.0]],"view":[30.0,-5.0]})",
       R"({"do":"translate","points":[[1.0,2.0],[3.0,4.0]]})", R"({"do":"pull","points":[[1.0,2.0],[3.0,4.0]]})",
       R"({"do":"brush","points":[[1.0,2.0]],"radius":7.5})", R"({"do":"unbrush","points":[[1.0,2.0]],"radius":7.5})",
       R"({"do":"roll","level":-3})", R"({"do":"gesture","points":[[1.0,2.0],[3.0,4.0]],"view":[-90.0,0.0]})"})
    EXPECT_EQ(EventToJson(EventFromJson(Json::parse(text))).dump(), text);
}

TEST(SessionEventJson, SaysWhatIsWrongWithoutAFile) {
  ExpectError([] { EventFromJson(Json()); }, "it has no text 'do'");
  ExpectError([] { EventFromJson({{"do", 3}}); }, "it has no text 'do'");
  ExpectError([] { EventFromJson({{"do", "drow"}}); }, "\"drow\" is unknown (expected draw, erase");
  ExpectError([] { EventFromJson({{"do", "draw"}, {"points", {{1, 2}}}, {"wieght", 2}}); }, "'draw' takes no 'wieght'");
  ExpectError([] { EventFromJson({{"do", "roll"}, {"level", 4}}); }, "'level' is 4 (expected -3 to 3 without 0)");
}

TEST_F(SessionFileTest, RefusesOtherFiles) {
  ExpectError([&] { Read("{"); }, "record the session again");
  ExpectError([&] { ReadSession(folder_.path()); }, "no regular file");
  ExpectError([&] { ReadEvents(R"({"do": ")" + std::string(100'000, 'z') + "\"}"); }, "zzz... is unknown");
  ExpectError([&] { Read("[]"); }, "it has no 'version'");
  ExpectError([&] { Read(R"({"version": 2})"); }, "version 2 (this program reads 1)");
  ExpectError([&] { Read(R"({"version": 1, "sheet": [3, 3], "events": []})"); }, "no list of 1 to");
  ExpectError([&] { Read(R"({"version": 1, "sheet": [0, 3], "events": []})"); }, "expected sizes from 1 to");
  ExpectError([&] { Read(R"({"version": 1, "sheet": [3, 3], "Begin": "mean"})"); }, "'Begin' is unknown");
  ExpectError([&] { Read(R"({"version": 1, "sheet": 3, "events": []})"); }, "'sheet' is 3, expected [width, height]");
}

}  // namespace
}  // namespace daumier::sketch
