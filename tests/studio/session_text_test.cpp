#include "studio/session_text.h"

#include "core/files.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::studio {
namespace {

TEST(SessionText, IsReadAsTheSameSession) {
  const testing::TempDir folder;
  for (const char* name : {"front", "side"}) {
    const sketch::SessionScript script =
        sketch::ReadSession(testing::SourceRoot() / "docs/examples/sessions" / (std::string(name) + ".json"));
    SessionText grown({.width = script.width, .height = script.height, .begin = script.begin, .events = {}});
    for (const sketch::SessionEvent& event : script.events) grown.Append(event);
    EXPECT_EQ(grown.text(), SessionText(script).text()) << "event by event or at once";
    WriteFileAtomically(folder / "session.json", grown.text());
    EXPECT_EQ(sketch::SessionToJson(sketch::ReadSession(folder / "session.json")), sketch::SessionToJson(script));
    EXPECT_EQ(size_t(std::ranges::count(grown.text(), '\n')), script.events.size() + 2) << "a line an event";
  }
}

}  // namespace
}  // namespace daumier::studio
