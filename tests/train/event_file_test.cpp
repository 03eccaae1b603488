#include "train/event_file.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

TEST(EventFile, ReadsWhatWasWrittenAlsoAfterReopening) {
  const testing::TempDir folder;
  const auto file = folder / "events.out.tfevents.test";
  EventWriter(file).Write({12.5, 3, "train/loss", 0.25f});
  EventWriter(file).Write({13.5, 400, "validation/mean_vertex_error_mm", -2.0f});
  const std::vector<ScalarEvent> events = ReadEvents(file);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].wall_time, 12.5);
  EXPECT_EQ(events[0].step, 3);
  EXPECT_EQ(events[0].tag, "train/loss");
  EXPECT_EQ(events[0].value, 0.25f);
  EXPECT_EQ(events[1].step, 400);
  EXPECT_EQ(events[1].tag, "validation/mean_vertex_error_mm");
  EXPECT_EQ(events[1].value, -2.0f);
}

TEST(EventFile, HasTheBytesOfTheFormat) {
  // The head that TensorFlow's own writer gives for wall time 0: length 24, its masked crc, the message, its masked
  // crc.
  const testing::TempDir folder;
  const auto file = folder / "events.out.tfevents.test";
  EventWriter(file).Write({0, 1, "a", 1.0f});
  const std::string bytes = ReadFile(file);
  const std::string head("\x1a\0\0\0\0\0\0\0", 8);
  EXPECT_EQ(bytes.substr(0, 8), head);
  const std::string message = std::string("\x09\0\0\0\0\0\0\0\0\x10\0\x1a\x0d", 13) + "brain.Event:2";
  EXPECT_EQ(bytes.substr(12, 26), message);
  const std::string event(
      "\x09\0\0\0\0\0\0\0\0\x10\x01\x2a\x0a\x0a\x08\x0a\x01"
      "a\x15\0\0\x80\x3f",
      23);
  EXPECT_EQ(bytes.substr(8 + 4 + 26 + 4 + 8 + 4, 23), event);
}

TEST(EventFile, StopsAtARecordThatIsCutShortOrDamaged) {
  const testing::TempDir folder;
  const auto file = folder / "events.out.tfevents.test";
  for (int step = 0; step < 3; ++step) EventWriter(file).Write({0, step, "loss", 1.0f});
  const std::string bytes = ReadFile(file);
  WriteFileAtomically(file, bytes.substr(0, bytes.size() - 5));
  EXPECT_EQ(ReadEvents(file).size(), 2u);
  std::string damaged = bytes;
  damaged[bytes.size() - 6] ^= 1;
  WriteFileAtomically(file, damaged);
  EXPECT_EQ(ReadEvents(file).size(), 2u);
}

TEST(EventFile, RefusesAnotherKindOfFileAndAFolderThatIsNotThere) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "text", "this is not an event file at all");
  testing::ExpectError([&] { ReadEvents(folder / "text"); }, "no TensorBoard event file");
  testing::ExpectError([&] { EventWriter(folder / "missing" / "events"); }, "cannot be opened");
}

}  // namespace
}  // namespace daumier::train
