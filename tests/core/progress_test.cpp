#include "core/progress.h"

#include "core/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace daumier {
namespace {

using ::testing::HasSubstr;

TEST(Progress, LineTellsCountRateAndTimeLeft) {
  EXPECT_EQ(ProgressLine("sketches", 120, 600, "faces", 5), "sketches: 120/600 faces, 24/s, 20 s left");
  EXPECT_EQ(ProgressLine("sketches", 1, 600, "faces", 4), "sketches: 1/600 faces, 0.25/s, 39 min 56 s left");
  EXPECT_EQ(ProgressLine("train", 9000, 10000, "steps", 3), "train: 9000/10000 steps, 3000/s, 0 s left");
}

TEST(Progress, LineOfNothingDoneHasNoTimeLeft) {
  EXPECT_EQ(ProgressLine("sketches", 0, 600, "faces", 5), "sketches: 0/600 faces, 0/s");
}

TEST(Progress, LineOfAllDoneTellsItsTime) {
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
