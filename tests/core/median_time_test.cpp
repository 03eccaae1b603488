#include "core/median_time.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier {
namespace {

TEST(MedianMs, IgnoresASlowFirstCall) {
  int calls = 0;
  const double ms = MedianMs([&] {
    if (++calls == 1) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  });
  EXPECT_EQ(calls, 51);
  EXPECT_LT(ms, 100);
}

}  // namespace
}  // namespace daumier
