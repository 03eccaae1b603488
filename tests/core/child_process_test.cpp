#include "core/child_process.h"

#include "core/stopwatch.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <thread>

namespace daumier {
namespace {

using testing::TempDir;

TEST(ChildProcess, ReturnsExitCodeAndBothOutputs) {
  const TempDir folder;
  const auto child = RunChild({"sh", "-c", "echo out; echo err >&2; exit 3"}, folder.path(), {});
  ASSERT_TRUE(child.has_value());
  EXPECT_EQ(child->exit_code, 3);
  EXPECT_EQ(child->out, "out\n");
  EXPECT_EQ(child->err, "err\n");
}

TEST(ChildProcess, ArgumentsPassNoShell) {
  const TempDir folder;
  EXPECT_EQ(RunChild({"echo", "a  b; $HOME"}, folder.path(), {})->out, "a  b; $HOME\n");
}

TEST(ChildProcess, IsNothingWhereTheProgramIsMissing) {
  const TempDir folder;
  EXPECT_FALSE(RunChild({"daumier-no-such-program"}, folder.path(), {}).has_value());
}

TEST(ChildProcess, SignalsAndTimeoutsAreErrors) {
  const TempDir folder;
  testing::ExpectError([&] { RunChild({"sh", "-c", "kill -9 $$"}, folder.path(), {}); }, "ended by signal 9");
  testing::ExpectError(
      [&] {
        RunChild({"sleep", "60"}, folder.path(), {.timeout_seconds = 0.05});
      },
      "sleep did not end within 0.05 s");
}

TEST(ChildProcess, RunsInItsFolder) {
  const TempDir folder;
  const auto child = RunChild({"pwd", "-P"}, folder.path(), {.folder = folder.path()});
  EXPECT_EQ(child->out, std::filesystem::canonical(folder.path()).string() + "\n");
}

TEST(ChildProcess, EndsWithItsTask) {
  const TempDir folder;
  std::stop_source stop;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop.request_stop();
  });
  const Stopwatch watch;
  EXPECT_THROW(RunChild({"sleep", "60"}, folder.path(), {.task = Task(stop.get_token())}), Cancelled);
  EXPECT_LT(watch.seconds(), 30);
}

}  // namespace
}  // namespace daumier
