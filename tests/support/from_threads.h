#pragma once
#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace daumier::testing {

/// Calls `make` from eight threads at once, `repeats` times in each, and expects the value of a call from this thread:
/// the test of what a header calls thread-safe. Under ThreadSanitizer a race fails it as well.
template <class Make>
void ExpectTheSameFromThreads(int repeats, const Make& make) {
  const auto expected = make();
  std::vector<std::future<int>> threads;
  for (int thread = 0; thread < 8; ++thread) {
    threads.push_back(std::async(std::launch::async, [&] {
      int num_equal = 0;
      for (int i = 0; i < repeats; ++i) num_equal += make() == expected ? 1 : 0;
      return num_equal;
    }));
  }
  for (auto& thread : threads) EXPECT_EQ(thread.get(), repeats);
}

}  // namespace daumier::testing
