#include "core/process_task.h"

#include "core/interrupt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier {
namespace {

TEST(TaskOfProcess, IsCancelledByAnInterrupt) {
  const Task task = TaskOfProcess();
  EXPECT_FALSE(task.cancelled());
  SetInterrupted(true);
  EXPECT_TRUE(task.cancelled());
  EXPECT_TRUE(TaskOfProcess().cancelled());
  SetInterrupted(false);
  EXPECT_FALSE(TaskOfProcess().cancelled());
}

TEST(TaskOfProcess, PrintsItsStagesOnStderr) {
  ::testing::internal::CaptureStderr();
  {
    const Task task = TaskOfProcess();
    task.Stage("faces").Report(3, 3, "faces");
    task.Stage("sketches").Report(1, 3, "faces");
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, ::testing::HasSubstr("faces: 3/3 faces"));
  EXPECT_THAT(text, ::testing::HasSubstr("sketches: 1/3 faces"));
}

TEST(TaskOfProcess, EachHasALineOfItsOwn) {
  ::testing::internal::CaptureStderr();
  {
    const Task first = TaskOfProcess().Stage("first"), second = TaskOfProcess().Stage("second");
    for (int i = 0; i <= 2; ++i) {
      first.Report(i, 2, "faces");
      second.Report(i, 2, "faces");
    }
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

}  // namespace
}  // namespace daumier
