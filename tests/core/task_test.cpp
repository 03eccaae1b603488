#include "core/task.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace daumier {
namespace {

TEST(Task, DefaultIsNeverCancelledAndSilent) {
  const Task task;
  EXPECT_FALSE(task.cancelled());
  EXPECT_FALSE(task.stop.stop_possible());
  task.ThrowIfCancelled("stopped after {} of {}", 1, 2);
  task.Report(1, 2, "faces");
}

TEST(Task, CopiesAreCancelledTogether) {
  std::stop_source source;
  const Task task(source.get_token());
  const Task copy = task.Stage("sketches");  // NOLINT(performance-unnecessary-copy-initialization)
  source.request_stop();
  EXPECT_TRUE(task.cancelled());
  EXPECT_TRUE(copy.cancelled());
}

TEST(Task, CancelledOneThrowsTheMessageOfItsFunction) {
  std::stop_source source;
  const Task task(source.get_token());
  source.request_stop();
  testing::ExpectError(
      [&] { task.ThrowIfCancelled("{}: stopped after {} shards; the same command resumes", "out", 3); },
      "out: stopped after 3 shards; the same command resumes");
  EXPECT_THROW(task.ThrowIfCancelled("stopped"), Cancelled);
}

TEST(Task, ReportsReachTheCallbackOnceWithTheirStage) {
  std::vector<std::string> reports;
  const Task task({}, [&](const TaskProgress& progress) {
    reports.push_back(
        fmt::format("{}|{}|{}|{}|{}", progress.stage, progress.done, progress.total, progress.unit, progress.note));
  });
  task.Report(0, 5, "faces");
  task.Stage("sketches").Report(2, 5, "faces", "loss 0.5");
  EXPECT_EQ(reports, (std::vector<std::string>{"|0|5|faces|", "sketches|2|5|faces|loss 0.5"}));
}

TEST(Task, MembersAreCalledFromSeveralThreads) {
  std::stop_source source;
  std::atomic<int> num_reports = 0, num_cancelled = 0;
  const Task task(source.get_token(), [&](const TaskProgress&) { ++num_reports; });
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        const Task copy = task.Stage("sketches");
        for (int i = 0; i < 100; ++i) copy.Report(i, 100, "faces");
        if (t == 0) source.request_stop();
        while (!copy.cancelled()) std::this_thread::yield();
        ++num_cancelled;
      });
    }
  }
  EXPECT_EQ(num_reports, 400);
  EXPECT_EQ(num_cancelled, 4);
}

}  // namespace
}  // namespace daumier
