#include "core/log.h"

#include "tests/support/process.h"
#include "tests/support/warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace daumier::log {
namespace {

using ::testing::HasSubstr;

TEST(Log, WritesToStderrOnly) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Info("{} of {}", 1, "two");
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("info 1 of two\n"));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Log, BracesOfAMessageAreText) {
  ::testing::internal::CaptureStderr();
  Write(Level::kInfo, "{} {0} {x}");
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("{} {0} {x}\n"));
}

TEST(Log, MessagesBelowTheLevelAreNotWritten) {
  const Level before = GetLevel();
  ::testing::internal::CaptureStderr();
  Write(Level::kDebug, "debug one");
  SetLevel(Level::kDebug);
  Write(Level::kDebug, "debug two");
  SetLevel(Level::kError);
  Info("info");
  SetLevel(before);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, HasSubstr("debug two"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("debug one")));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("info")));
}

/// Warns only in the process that the next test starts.
TEST(LogChild, WarnsIfRequested) {
  if (std::getenv("DAUMIER_TEST_WARNS") != nullptr) Warn("this test fails by its warning");
}

TEST(Log, AWarningFailsATest) {
  const std::string program = std::filesystem::canonical("/proc/self/exe").string();
  const std::vector<std::string> silent = {program, "--gtest_filter=LogChild.*"};
  EXPECT_EQ(testing::RunProcess(silent).exit_code, 0);
  const testing::ProcessResult warned =
      testing::RunProcess({"/usr/bin/env", "DAUMIER_TEST_WARNS=1", program, "--gtest_filter=LogChild.*"});
  EXPECT_EQ(warned.exit_code, 1);
  EXPECT_THAT(warned.out, HasSubstr("1 warning(s) were logged"));
}

TEST(Log, CountsWarningsAndErrorsEvenWhenOff) {
  testing::AllowWarnings();
  const Level before = GetLevel();
  const int num_before = NumWarnings();
  SetLevel(Level::kOff);
  ::testing::internal::CaptureStderr();
  Warn("a {}", "warning");
  Write(Level::kError, "an error");
  Info("no warning");
  SetLevel(before);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(NumWarnings(), num_before + 2);
}

}  // namespace
}  // namespace daumier::log
