#include "core/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace daumier {
namespace {

/// Gives the signals back as they were.
class Interrupt : public ::testing::Test {
 protected:
  void TearDown() override {
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
