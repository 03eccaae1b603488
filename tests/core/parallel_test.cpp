#include "core/parallel.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

namespace daumier {
namespace {

TEST(ForEachInOrder, ResultsAreMergedInOrderByAnyNumberOfThreads) {
  for (const unsigned max_threads : {1u, 2u, 8u}) {
    std::vector<int> merged;
    const auto slow_if_early = [](int i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(i % 3 == 0 ? 2 : 0));
      return i * i;
    };
    ForEachInOrder(
        20, slow_if_early, [&](int result) { merged.push_back(result); }, max_threads);
    ASSERT_EQ(merged.size(), 20u);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(merged[i], i * i);
  }
}

TEST(ForEachInOrder, ErrorsEndTheLoop) {
  std::atomic<int> begun = 0;
  int merged = 0;
  const auto fails_at_3 = [&](int i) {
    ++begun;
    DAUMIER_CHECK(i != 3, "number {} fails", i);
    return i;
  };
  testing::ExpectError(
      [&] {
        ForEachInOrder(
            100, fails_at_3, [&](int) { ++merged; }, 2);
      },
      "number 3 fails");
  EXPECT_EQ(merged, 3);
  EXPECT_LE(begun, 5);
}

TEST(ForEachInOrder, NothingToDoIsDone) {
  ForEachInOrder(
      0, [](int i) { return i; }, [](int) { FAIL(); });
}

TEST(OnAllCores, EveryIndexIsWorkedOnOnce) {
  for (const int64_t count : {0, 1, 2, 3, 1000}) {
    std::vector<int> calls(static_cast<size_t>(count));
    OnAllCores(count, [&](int64_t i) { ++calls[static_cast<size_t>(i)]; });
    EXPECT_EQ(calls, std::vector<int>(static_cast<size_t>(count), 1));
  }
  testing::ExpectError([] { OnAllCores(3, [](int64_t i) { DAUMIER_CHECK(i != 1, "number {} fails", i); }); },
                       "number 1 fails");
}

}  // namespace
}  // namespace daumier
