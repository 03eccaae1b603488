// Sessions of a desk that outlive it, or leave its memory.
#include "studio/api.h"
#include "tests/studio/sketch_desk_fixture.h"
#include "tests/support/expect_error.h"

#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::WrinkleEvent;

TEST_F(SketchDeskTest, ASessionIsTheSameAfterARestart) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.name = "Zoë"});
  for (const Json& event : testing::FaceEvents()) desk.Do(id, event);
  ASSERT_TRUE(desk.State(id)["has_face"]);
  EXPECT_EQ(OpenDesk().State(id), desk.State(id)) << "in initial mode";
  desk.Do(id, EventOf("follow_up"));
  desk.Do(id, EraseEvent(desk.State(id)));
  const Json ends = desk.State(id)["open_ends"];
  ASSERT_EQ(ends.size(), 1u);
  const double x = (ends[0][0][0].get<double>() + ends[0][1][0].get<double>()) / 2,
               y = (ends[0][0][1].get<double>() + ends[0][1][1].get<double>()) / 2 - 9;
  desk.Do(id, testing::DrawEvent({ends[0][0], {x, y}, ends[0][1]}));
  EXPECT_EQ(desk.State(id)["open_ends"].size(), 0u);
  desk.Do(id, WrinkleEvent());
  desk.Do(id, EventOf("undo"));
  desk.Do(id, EventOf("undo"));
  desk.Do(id, EventOf("redo"));

  SketchDesk second = OpenDesk();
  EXPECT_EQ(second.List(), desk.List());
  EXPECT_EQ(second.State(id), desk.State(id));
  EXPECT_EQ(second.Face(id), desk.Face(id)) << "the bytes of the face";
  for (const char* what : {"redo", "undo", "undo", "undo", "undo", "undo", "redo"}) {
    const Json state = desk.Do(id, EventOf(what));
    EXPECT_EQ(WithoutEvent(second.Do(id, EventOf(what))), WithoutEvent(state)) << what;
    EXPECT_EQ(second.Face(id), desk.Face(id)) << what;
  }
}

TEST_F(SketchDeskTest, ASessionThatBeginsWithAFaceBeginsWithItAgain) {
  SketchDesk desk = OpenDesk();
  const geometry::Points face = 1.1 * Neutral();
  const std::string given = desk.Add({.begin = face}), mean = desk.Add({.begins_with_mean = true});
  EXPECT_EQ(desk.State(given)["mode"], "follow_up");
  EXPECT_EQ(desk.Face(given), face);
  EXPECT_EQ(desk.Face(mean), Neutral());
  for (const std::string& id : {given, mean}) {
    EXPECT_EQ(OpenDesk().State(id), desk.State(id)) << "without an event";
    EXPECT_EQ(OpenDesk().Face(id), desk.Face(id));
    desk.Do(id, WrinkleEvent());
    EXPECT_EQ(OpenDesk().State(id), desk.State(id));
    EXPECT_EQ(OpenDesk().Face(id), desk.Face(id));
  }
  EXPECT_EQ(sketch::ReadSession(desk.FileOf(mean)).begin, "mean");
  const std::string begin = sketch::ReadSession(desk.FileOf(given)).begin;
  EXPECT_TRUE(fs::is_regular_file(desk.FileOf(given).parent_path() / begin))
      << "as `daumier predict --session` needs it";
}

TEST_F(SketchDeskTest, ARecordedSessionIsDoneAtOnce) {
  SketchDesk desk = OpenDesk();
  sketch::SessionScript script{.width = 300, .height = 200, .begin = "mean", .events = {}};
  script.events.push_back({.what = sketch::SessionEvent::What::kDraw, .points = {{5, 5}, {9, 9}}});
  script.events.push_back({.what = sketch::SessionEvent::What::kUndo});
  const std::string id = desk.Add({.name = "Old", .recorded = script});
  const Json state = desk.State(id);
  EXPECT_EQ(state["sheet"], Json::parse("[300.0, 200.0]"));
  EXPECT_EQ(state["can_redo"], true);
  EXPECT_EQ(state["mode"], "follow_up");
  EXPECT_EQ(sketch::SessionToJson(sketch::ReadSession(desk.FileOf(id))), sketch::SessionToJson(script));
  EXPECT_EQ(OpenDesk().State(id), state) << "its revision, too";
}

TEST_F(SketchDeskTest, ARecordedSessionWhoseFaceIsAnotherFileIsRefused) {
  SketchDesk desk = OpenDesk();
  for (const char* begin : {"begin.obj", "mine.obj", "../s-0001/begin.obj"}) {
    const sketch::SessionScript script{
        .width = 300, .height = 200, .begin = begin, .events = {{.what = sketch::SessionEvent::What::kRefine}}};
    EXPECT_THROW(desk.Add({.recorded = script}), Error) << begin;
    EXPECT_TRUE(IsEmpty());
  }
}

TEST_F(SketchDeskTest, ASessionThatCannotBeginLeavesNothing) {
  SketchDesk desk = OpenDesk();
  ExpectError([&] { desk.Add({.begin = Neutral().topRows(5)}); }, "a face of 5 vertices");
  sketch::SessionScript script{.width = 300, .height = 200, .begin = "", .events = {}};
  script.events.push_back({.what = sketch::SessionEvent::What::kDraw, .points = {{1, 1}}});
  ExpectError([&] { desk.Add({.recorded = script}); }, "event 1 (draw): a stroke is shorter");
  script.events.clear();
  script.width = 1e9;
  ExpectError([&] { desk.Add({.recorded = script}); }, "expected sizes from 1 to");
  EXPECT_EQ(desk.List(), Json::array());
  EXPECT_TRUE(IsEmpty());
}

TEST_F(SketchDeskTest, ASessionThatIsFullTakesNoEvent) {
  SketchDesk desk = OpenDesk();
  sketch::SessionScript script{.width = 300, .height = 200, .begin = "", .events = {}};
  script.events.assign(sketch::kMostEvents, {.what = sketch::SessionEvent::What::kUndo});
  const std::string id = desk.Add({.recorded = script}), bytes = Bytes(id);
  ExpectError([&] { desk.Do(id, WrinkleEvent()); }, "the session has 2000 events, which is the most");
  EXPECT_EQ(Bytes(id), bytes);
  EXPECT_NO_THROW(OpenDesk().State(id)) << "it can be read";
  script.events.pop_back();
  const std::string almost = desk.Add({.recorded = script});
  desk.Do(almost, WrinkleEvent());
  ExpectError([&] { desk.Do(almost, WrinkleEvent()); }, "which is the most");
  EXPECT_EQ(OpenDesk().DrawnStrokes(almost).size(), 1u);
}

TEST_F(SketchDeskTest, ASessionNeverHasMorePointsThanAreRead) {
  SketchDesk desk = OpenDesk();
  sketch::SessionScript script{.width = 300, .height = 200, .begin = "", .events = {}};
  script.events.push_back(
      {.what = sketch::SessionEvent::What::kErase, .points = sketch::CanvasPoints(sketch::kMostSessionPoints, {1, 1})});
  const std::string id = desk.Add({.recorded = script});
  EXPECT_THROW(desk.Do(id, WrinkleEvent()), Error) << "it could not be read after a restart";
}

TEST_F(SketchDeskTest, SessionsThatAreNotInMemoryAreReadAgain) {
  SketchDesk desk = OpenDesk();
  std::vector<std::string> ids;
  std::vector<Json> states;
  for (size_t i = 0; i < SketchDesk::kMostOpen + 3; ++i) {
    ids.push_back(desk.Add({.begins_with_mean = true}));
    for (size_t event = 0; event <= i % 3; ++event) desk.Do(ids.back(), WrinkleEvent(int(event)));
    states.push_back(desk.State(ids.back()));
  }
  for (size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(desk.State(ids[i]), states[i]) << ids[i];
  EXPECT_EQ(desk.Do(ids[0], EventOf("undo"))["lines"].size() + 1, states[0]["lines"].size());
}

TEST_F(SketchDeskTest, OthersAreUsedWhileASessionIsRead) {
  {
    SketchDesk desk = OpenDesk();
    for (int i = 0; i < 2; ++i) desk.Do(desk.Add({.name = "Slow"}), WrinkleEvent());
  }
  // A pipe is not opened for reading until it is opened for writing; then it is refused.
  const fs::path about = folder_ / "s-0001/about.json";
  const std::string bytes = ReadFile(about);
  fs::remove(about);
  ASSERT_EQ(mkfifo(about.c_str(), 0600), 0);
  SketchDesk desk = OpenDesk();
  std::atomic<int> num_refused = 0;
  std::vector<std::jthread> readers;
  for (int i = 0; i < 2; ++i)
    readers.emplace_back([&] {
      ExpectError([&] { desk.State("s-0001"); }, "about.json: not a file");
      ++num_refused;
    });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(desk.Do("s-0002", WrinkleEvent(1))["changed"], true);
  EXPECT_EQ(desk.List().size(), 1u) << "the other one is no file";
  desk.Remove(desk.Add({}));
  EXPECT_EQ(num_refused, 0) << "it is still being read";
  std::ofstream pipe(about);
  readers.clear();
  EXPECT_EQ(num_refused, 2);
  fs::remove(about);
  WriteFileAtomically(about, bytes);
  EXPECT_EQ(desk.State("s-0001")["name"], "Slow") << "what failed is tried again";
}

TEST_F(SketchDeskTest, ADamagedSessionIsAnErrorAndOthersAreListed) {
  {
    SketchDesk desk = OpenDesk();
    for (int i = 0; i < 2; ++i) desk.Do(desk.Add({}), WrinkleEvent());
    desk.Do(desk.Add({.begin = 1.1 * Neutral()}), WrinkleEvent());
  }
  WriteFileAtomically(folder_ / "s-0001/session.json", "{\"version\": 1");
  fs::remove(folder_ / "s-0003/begin.obj");
  MakeDirectory(folder_ / "s-0004");
  SketchDesk desk = OpenDesk();
  EXPECT_EQ(desk.List().size(), 3u) << "a folder without about.json is no session";
  ExpectError([&] { desk.State("s-0001"); }, "session.json");
  ExpectError([&] { desk.State("s-0003"); }, "begin.obj");
  ExpectError([&] { desk.State("s-0004"); }, "about.json");
  EXPECT_EQ(desk.State("s-0002")["revision"], 1);
  desk.Remove("s-0001");
  EXPECT_EQ(desk.List().size(), 2u);
}

TEST_F(SketchDeskTest, ADamagedRecordIsAnErrorOfOurs) {
  OpenDesk().Add({});
  for (const char* about : {"{", "[]", "{}", R"({"name": "a"})", R"({"name": 3, "sheet": [9, 9]})",
                            R"({"name": "a", "sheet": [9]})", R"({"name": "a", "sheet": [0, 9]})"}) {
    WriteFileAtomically(folder_ / "s-0001/about.json", about);
    SketchDesk desk = OpenDesk();
    EXPECT_NO_THROW(desk.List()) << about;
    EXPECT_THROW(desk.State("s-0001"), Error) << about;
  }
}

TEST_F(SketchDeskTest, CallsOfOneSessionFromSeveralThreadsWaitForEachOther) {
  SketchDesk desk = OpenDesk();
  const std::string id = desk.Add({.begins_with_mean = true});
  constexpr int kThreads = 4, kEvents = 3;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kEvents; ++i) {
          EXPECT_EQ(desk.Do(id, WrinkleEvent(kEvents * thread + i))["changed"], true);
          EXPECT_EQ(desk.State(id)["id"], id);
          EXPECT_TRUE(desk.Face(id).allFinite());
          desk.List();
        }
      });
  }
  EXPECT_EQ(desk.State(id)["revision"], kThreads * kEvents);
  EXPECT_EQ(sketch::ReadSession(desk.FileOf(id)).events.size(), size_t(kThreads * kEvents));
  EXPECT_EQ(OpenDesk().State(id), desk.State(id));
}

TEST_F(SketchDeskTest, NoEventIsLostWhileMoreSessionsAreUsedThanStayInMemory) {
  SketchDesk desk = OpenDesk();
  std::vector<std::string> ids;
  for (size_t i = 0; i < SketchDesk::kMostOpen + 2; ++i) ids.push_back(desk.Add({.begins_with_mean = true}));
  constexpr int kThreads = 4;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (const std::string& id : ids) desk.Do(id, WrinkleEvent(thread));
      });
  }
  for (const std::string& id : ids)
    EXPECT_EQ(sketch::ReadSession(desk.FileOf(id)).events.size(), size_t(kThreads)) << id;
}

}  // namespace
}  // namespace daumier::studio
