#include "core/interrupt.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

namespace daumier {
namespace {

/// Whether a stop is requested within ten seconds.
bool StopsSoon(const std::stop_token& token) {
  for (int i = 0; i < 10000 && !token.stop_requested(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return token.stop_requested();
}

/// Gives the signals back as they were.
class Interrupt : public ::testing::Test {
 protected:
  void TearDown() override {
    // The stop of a signal arrives from another thread; the next test must not see it.
    if (Interrupted()) {
      EXPECT_TRUE(StopsSoon(InterruptToken()));
    }
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    SetInterrupted(false);
  }
};

TEST_F(Interrupt, FirstCtrlCOnlySetsTheFlag) {
  CatchInterrupts();
  EXPECT_FALSE(Interrupted());
  std::raise(SIGINT);
  EXPECT_TRUE(Interrupted());
}

TEST_F(Interrupt, TermCountsAsCtrlC) {
  CatchInterrupts();
  std::raise(SIGTERM);
  EXPECT_TRUE(Interrupted());
}

TEST_F(Interrupt, FirstCtrlCStopsTheToken) {
  CatchInterrupts();
  const std::stop_token token = InterruptToken();
  EXPECT_FALSE(token.stop_requested());
  std::raise(SIGINT);
  EXPECT_TRUE(StopsSoon(token));
}

TEST_F(Interrupt, ForgettingLeavesOldTokensStoppedAndGivesNewOnes) {
  const std::stop_token before = InterruptToken();
  SetInterrupted(false);
  EXPECT_EQ(before, InterruptToken());  // Nothing to forget.
  SetInterrupted(true);
  EXPECT_TRUE(before.stop_requested());
  SetInterrupted(false);
  EXPECT_TRUE(before.stop_requested());
  EXPECT_FALSE(InterruptToken().stop_requested());
}

TEST_F(Interrupt, TokensAreHandedToSeveralThreads) {
  std::atomic<int> num_stopped = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        const std::stop_token token = InterruptToken();
        num_stopped += StopsSoon(token);
      });
    }
    SetInterrupted(true);
  }
  EXPECT_EQ(num_stopped, 4);
}

TEST_F(Interrupt, FlagCanBeSetAndForgotten) {
  SetInterrupted(true);
  EXPECT_TRUE(Interrupted());
  SetInterrupted(false);
  EXPECT_FALSE(Interrupted());
}

TEST(InterruptDeathTest, SecondOneKills) {
  const auto twice = [](int first, int second) {
    CatchInterrupts();
    std::raise(first);
    std::raise(second);
    std::exit(0);
  };
  EXPECT_EXIT(twice(SIGINT, SIGINT), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(twice(SIGINT, SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace daumier
