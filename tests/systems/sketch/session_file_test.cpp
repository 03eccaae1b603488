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
  script.events = {{SessionEvent::What::kDraw, {{1, 2.5}, {3, 4}}},
                   {SessionEvent::What::kFollowUp, {}},
                   {SessionEvent::What::kErase, {{7, 8}}},
                   {SessionEvent::What::kUndo, {}},
                   {SessionEvent::What::kRedo, {}}};
  const SessionScript read = Read(SessionToJson(script).dump());
  EXPECT_EQ(read.width, 300);
  EXPECT_EQ(read.height, 200);
  ASSERT_EQ(read.events.size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(read.events[i].what, script.events[i].what);
    EXPECT_EQ(read.events[i].points, script.events[i].points);
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
  refused(R"({"do": "draw"})", "'draw' has 0 points");
  refused(R"({"do": "undo", "points": [[1, 2]]})", "'undo' has 1 points");
  refused(R"({"do": "draw", "points": 7})", "'draw' has malformed points");
  refused(R"({"do": "draw", "points": [[1]]})", "[1] is no pair [x, y]");
  refused(R"({"do": "draw", "points": [[1, "a"]]})", "\"a\" is no number");
}

TEST_F(SessionFileTest, RefusesOtherFiles) {
  ExpectError([&] { Read("{"); }, "record the session again");
  ExpectError([&] { ReadSession(folder_.path()); }, "no regular file");
  ExpectError([&] { ReadEvents(R"({"do": ")" + std::string(100'000, 'z') + "\"}"); }, "zzz... is unknown");
  ExpectError([&] { Read("[]"); }, "it has no 'version'");
  ExpectError([&] { Read(R"({"version": 2})"); }, "version 2 (this program reads 1)");
  ExpectError([&] { Read(R"({"version": 1, "sheet": [3, 3], "events": []})"); }, "no list of 1 to");
  ExpectError([&] { Read(R"({"version": 1, "sheet": 3, "events": []})"); }, "'sheet' is 3, expected [width, height]");
}

}  // namespace
}  // namespace daumier::sketch
