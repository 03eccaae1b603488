#include "export/child_process.h"

#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

namespace daumier::exporting {
namespace {

using testing::TempDir;

TEST(ChildProcess, ReturnsExitCodeAndBothOutputs) {
  const TempDir folder;
  const auto child = RunChild({"sh", "-c", "echo out; echo err >&2; exit 3"}, folder.path(), 20);
  ASSERT_TRUE(child.has_value());
  EXPECT_EQ(child->exit_code, 3);
  EXPECT_EQ(child->out, "out\n");
  EXPECT_EQ(child->err, "err\n");
}

TEST(ChildProcess, ArgumentsPassNoShell) {
  const TempDir folder;
  EXPECT_EQ(RunChild({"echo", "a  b; $HOME"}, folder.path(), 20)->out, "a  b; $HOME\n");
}

TEST(ChildProcess, IsNothingWhereTheProgramIsMissing) {
  const TempDir folder;
  EXPECT_FALSE(RunChild({"daumier-no-such-program"}, folder.path(), 20).has_value());
}

TEST(ChildProcess, SignalsAndTimeoutsAreErrors) {
  const TempDir folder;
  testing::ExpectError([&] { RunChild({"sh", "-c", "kill -9 $$"}, folder.path(), 20); }, "ended by signal 9");
  testing::ExpectError([&] { RunChild({"sleep", "60"}, folder.path(), 0.05); }, "sleep did not end within 0.05 s");
}

}  // namespace
}  // namespace daumier::exporting
