// The test program starts itself through env(1), and one of its tests prints the child's arguments and environment.
#include "core/files.h"
#include "core/runtime.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>

namespace daumier {
namespace {

using ::testing::HasSubstr;

constexpr bool kSanitized =
#if defined(__SANITIZE_ADDRESS__)
    true;
#elif defined(__has_feature)
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
    false;
#endif

/// Prints the start of this process for the tests below.
TEST(PreinitChild, PrintsHowItWasStarted) {
  if (std::getenv("DAUMIER_TELL_START") == nullptr) return;
  const char* const policy = std::getenv("OMP_WAIT_POLICY");
  std::string arguments = ReadFile("/proc/self/cmdline");
  for (char& c : arguments) c = c == '\0' ? '|' : c;
  const char* const timeout = std::getenv("OPENBLAS_THREAD_TIMEOUT");
  std::cout << "policy=" << (policy != nullptr ? policy : "none")
            << "\ntimeout=" << (timeout != nullptr ? timeout : "none") << "\nname=" << ReadFile("/proc/self/comm")
            << "arguments=" << arguments << "\n";
}

/// What the child prints when env(1) starts it with these changes of the environment.
std::string RunChild(const std::vector<std::string>& changes) {
  const std::string program = std::filesystem::canonical("/proc/self/exe").string();
  std::vector<std::string> command = {
      "/usr/bin/env", "-u", "OMP_WAIT_POLICY", "-u", "OPENBLAS_THREAD_TIMEOUT", "-u", "DAUMIER_RESTARTED"};
  command.insert(command.end(), changes.begin(), changes.end());
  command.insert(command.end(), {"DAUMIER_TELL_START=1", program, "--gtest_filter=PreinitChild.*", "two words", ""});
  const testing::ProcessResult result = testing::RunProcess(command);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

class Preinit : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "programs built for the sanitizers are not started again";
  }
};

TEST_F(Preinit, ProgramStartedWithoutWaitPolicyHasThePassiveOne) {
  EXPECT_THAT(RunChild({}), HasSubstr("policy=PASSIVE\n"));
}

TEST_F(Preinit, WaitPolicyOfTheUserStays) {
  EXPECT_THAT(RunChild({"OMP_WAIT_POLICY=active"}), HasSubstr("policy=active\n"));
}

TEST_F(Preinit, OpenBlasWaitsBriefly) {
  EXPECT_THAT(RunChild({}), HasSubstr("timeout=20\n"));
  EXPECT_THAT(RunChild({"OMP_WAIT_POLICY=active"}), HasSubstr("policy=active\ntimeout=20\n"));
  EXPECT_THAT(RunChild({"OPENBLAS_THREAD_TIMEOUT=9"}), HasSubstr("policy=PASSIVE\ntimeout=9\n"));
}

TEST_F(Preinit, ArgumentsAndNameSurvive) {
  const std::string out = RunChild({});
  EXPECT_THAT(out, HasSubstr("|--gtest_filter=PreinitChild.*|two words||\n"));
  EXPECT_THAT(out, HasSubstr("name=daumier_core_te\n"));  // The kernel keeps 15 characters.
}

TEST_F(Preinit, ProgramRestartsOnlyOnce) {
  EXPECT_THAT(RunChild({"DAUMIER_RESTARTED=1"}), HasSubstr("policy=none\n"));
}

TEST_F(Preinit, EmptyEnvironmentIsEnough) {
  EXPECT_THAT(RunChild({"-i"}), HasSubstr("policy=PASSIVE\n"));
}

/// CPU seconds of the threads of this process other than the calling one.
double OtherThreadsSeconds() {
  const auto seconds = [](clockid_t clock) {
    timespec time = {};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  return seconds(CLOCK_PROCESS_CPUTIME_ID) - seconds(CLOCK_THREAD_CPUTIME_ID);
}

TEST_F(Preinit, ThreadsSleepWhileTheyWait) {
  // After each threaded product the calling thread works alone for 50 ms. Active threads burn all of that time.
  if (NumCores() < 2) GTEST_SKIP() << "needs two cores";
  SetUpRuntime(2);
  double burnt = 0, waited = 0;
  for (int round = 0; round < 4; ++round) {
    MeasureSgemm(512, 1);
    const auto start = std::chrono::steady_clock::now();
    const double before = OtherThreadsSeconds();
    std::chrono::duration<double> alone{};
    while (alone.count() < 0.05) alone = std::chrono::steady_clock::now() - start;
    burnt += OtherThreadsSeconds() - before;
    waited += alone.count();
  }
  EXPECT_LT(burnt, 0.05 * waited);
}

}  // namespace
}  // namespace daumier
