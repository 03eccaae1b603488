#include "core/progress.h"

#include "core/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace daumier {
namespace {

using ::testing::HasSubstr;

TEST(Progress, LineShowsCountRateAndTimeLeft) {
  EXPECT_EQ(ProgressLine("sketches", 120, 600, "faces", 5), "sketches: 120/600 faces, 24/s, 20 s left");
  EXPECT_EQ(ProgressLine("sketches", 1, 600, "faces", 4), "sketches: 1/600 faces, 0.25/s, 39 min 56 s left");
  EXPECT_EQ(ProgressLine("train", 9000, 10000, "steps", 3), "train: 9000/10000 steps, 3000/s, 0 s left");
}

TEST(Progress, RateOfALineIsThatSinceItsFirstCount) {
  EXPECT_EQ(ProgressLine("train", 9000, 10000, "steps", 4, 8000), "train: 9000/10000 steps, 250/s, 4 s left");
  EXPECT_EQ(ProgressLine("train", 8000, 10000, "steps", 4, 8000), "train: 8000/10000 steps, 0/s");
}

TEST(Progress, LineWithoutAStageBeginsWithItsCount) {
  EXPECT_EQ(ProgressLine("", 1, 2, "faces", 1), "1/2 faces, 1/s, 1 s left");
}

TEST(Progress, LineOfNothingDoneHasNoTimeLeft) {
  EXPECT_EQ(ProgressLine("sketches", 0, 600, "faces", 5), "sketches: 0/600 faces, 0/s");
}

TEST(Progress, LineOfAllDoneShowsTheElapsedTime) {
  EXPECT_EQ(ProgressLine("sketches", 600, 600, "faces", 60), "sketches: 600/600 faces, 10/s, took 1 min 00 s");
}

TEST(Progress, DurationsAreReadable) {
  EXPECT_EQ(FormatDuration(0.4), "0 s");
  EXPECT_EQ(FormatDuration(59.6), "1 min 00 s");
  EXPECT_EQ(FormatDuration(125), "2 min 05 s");
  EXPECT_EQ(FormatDuration(7620), "2 h 07 min");
}

TEST(Progress, PrintsOneLineAtItsEndWhereItIsShort) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("sketches", 3, "faces");
    for (int i = 0; i < 3; ++i) progress.Step(1, "loss 0.5");
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, HasSubstr("sketches: 3/3 faces"));
  EXPECT_THAT(text, HasSubstr("loss 0.5"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, RedrawsOneLineAtMostTwiceASecondOnATerminal) {
  int controller = -1, terminal = -1;
  if (openpty(&controller, &terminal, nullptr, nullptr, nullptr) != 0)
    GTEST_SKIP() << "there are no pseudo-terminals here: is /dev/pts mounted?";
  const int stderr_before = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("sketches", 1000000000, "faces");
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1200)) progress.Step();
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  dup2(stderr_before, STDERR_FILENO);
  close(stderr_before);
  std::string text;
  for (char piece[4096]; text.find('\n') == std::string::npos;) {
    const ssize_t num_read = read(controller, piece, sizeof(piece));
    if (num_read <= 0) break;
    text.append(piece, static_cast<size_t>(num_read));
  }
  close(terminal);
  close(controller);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  const auto num_drawn = std::count(text.begin(), text.end(), '\x1b');
  EXPECT_GE(num_drawn, 2);
  EXPECT_LE(num_drawn, static_cast<int>(2 * elapsed.count()) + 1);  // The last line is drawn in any case.
}

TEST(Progress, CountsStepsOfSeveralThreads) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("sketches", 4000, "faces");
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 1000; ++i) progress.Step();
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("4000/4000"));
}

TEST(Progress, ReportsCountsInOrderToItsTask) {
  std::vector<std::string> reports;
  const Task task({}, [&](const TaskProgress& report) {
    reports.push_back(fmt::format("{} {}/{} {} {}", report.stage, report.done, report.total, report.unit, report.note));
  });
  Progress progress(task.Stage("sketches"), 5, "faces");
  progress.Step(2, "loss 0.5");
  progress.Step(3);
  EXPECT_EQ(reports, (std::vector<std::string>{"sketches 0/5 faces ", "sketches 2/5 faces loss 0.5",
                                               "sketches 5/5 faces loss 0.5"}));
}

TEST(Progress, OfAResumedStageBeginsAtWhatIsFinished) {
  std::vector<std::string> reports;
  const Task task({}, [&](const TaskProgress& report) {
    reports.push_back(fmt::format("{}/{} {}", report.done, report.total, report.unit));
  });
  Progress progress(task, 80, "steps", 60);
  progress.Step(5);
  EXPECT_EQ(reports, (std::vector<std::string>{"60/80 steps", "65/80 steps"}));
}

/// What a printer writes to stderr in `calls`, a line an element.
template <class Calls>
std::vector<std::string> PrintedLines(const Calls& calls) {
  ::testing::internal::CaptureStderr();
  {
    ProgressPrinter printer;
    calls(printer);
  }
  std::istringstream text(::testing::internal::GetCapturedStderr());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(ProgressPrinter, EndsAStageWhenTheNextBegins) {
  const auto lines = PrintedLines([](ProgressPrinter& printer) {
    printer.Print({"faces", 0, 9, "faces", ""});
    printer.Print({"faces", 4, 9, "faces", ""});
    printer.Print({"sketches", 0, 2, "faces", ""});
    printer.Print({"sketches", 2, 2, "faces", "done"});
  });
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], HasSubstr("faces: 4/9 faces"));
  EXPECT_THAT(lines[1], HasSubstr("sketches: 2/2 faces"));
  EXPECT_THAT(lines[1], HasSubstr("done"));
}

TEST(ProgressPrinter, PrintsAFinishedStageOnceAndAgainWhenItRestarts) {
  const auto lines = PrintedLines([](ProgressPrinter& printer) {
    for (int epoch = 0; epoch < 3; ++epoch) {
      for (const int done : {0, 1, 2, 2}) printer.Print({"epoch", done, 2, "steps", ""});
    }
  });
  EXPECT_EQ(lines.size(), 3u);
}

TEST(ProgressPrinter, EndsAnUnfinishedStageWhenDestroyed) {
  const auto lines = PrintedLines([](ProgressPrinter& printer) { printer.Print({"train", 50, 100, "steps", ""}); });
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], HasSubstr("train: 50/100 steps"));
}

TEST(ProgressPrinter, PrintsNothingWithoutReports) {
  EXPECT_TRUE(PrintedLines([](ProgressPrinter&) {}).empty());
}

TEST(ProgressPrinter, TakesReportsOfSeveralThreads) {
  const auto lines = PrintedLines([](ProgressPrinter& printer) {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 1; i <= 1000; ++i) printer.Print({"sketches", i, 2000, "faces", "note"});
      });
    }
  });
  EXPECT_EQ(lines.size(), 1u);
}

TEST(Progress, IsSilentWhereTheLogIs) {
  const log::Level before = log::GetLevel();
  log::SetLevel(log::Level::kError);
  ::testing::internal::CaptureStderr();
  { Progress progress("sketches", 3, "faces"); }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  log::SetLevel(before);
}

}  // namespace
}  // namespace daumier
