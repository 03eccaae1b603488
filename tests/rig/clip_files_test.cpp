#include "rig/clip_files.h"

#include "core/files.h"
#include "rig/arkit_names.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

/// By content: the names of the files are wrong on purpose.
TEST(ReadClip, TellsFormatsByTheirContent) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "a.json", "time,jawOpen\n0,0.5\n");
  WriteFileAtomically(folder / "a.csv", "\xEF\xBB\xBF\n [{\"jawOpen\": 0.5}]");
  const int jaw = FindArkitName("jawOpen").value();
  for (const char* name : {"a.json", "a.csv"}) {
    const Recording recording = ReadClip(folder / name);
    EXPECT_EQ(recording.weights(0, jaw), 0.5f) << name;
    EXPECT_EQ(recording.weights.cols(), kNumArkitNames) << name;
  }
}

TEST(ReadClip, NamesTheFileThatIsNotThere) {
  testing::ExpectError([] { ReadClip("/nowhere/a.csv"); }, "/nowhere/a.csv");
}

}  // namespace
}  // namespace daumier::rig
