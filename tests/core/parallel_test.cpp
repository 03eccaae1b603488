#include "core/parallel.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

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

TEST(ForEachInOrder, ErrorsOfMergeEndTheLoop) {
  std::atomic<int> begun = 0;
  testing::ExpectError(
      [&] {
        ForEachInOrder(
            100, [&](int i) { return ++begun, i; }, [](int i) { DAUMIER_CHECK(i != 5, "merge {} fails", i); }, 3);
      },
      "merge 5 fails");
  EXPECT_LE(begun, 8);
}

TEST(ForEachInOrder, TheFirstErrorInOrderIsThrownAfterTheCallsUnderWayHaveEnded) {
  ThreadPool pool(7);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::atomic<int> num_under_way = 0;
    const auto late_is_fast = [&](int i) {
      ++num_under_way;
      std::this_thread::sleep_for(std::chrono::microseconds(i == 2 ? 500 : 10 * i));
      --num_under_way;
      DAUMIER_CHECK(i < 2, "number {} fails", i);
      return i;
    };
    testing::ExpectError(
        [&] {
          ForEachInOrder(
              50, late_is_fast, [](int) {}, 8, pool);
        },
        "number 2 fails");
    EXPECT_EQ(num_under_way, 0);
  }
}

TEST(ForEachInOrder, TheNumberOfPendingResultsIsBounded) {
  ThreadPool pool(7);
  std::atomic<int> num_results = 0, most = 0;
  const auto work = [&](int i) {
    const int now = ++num_results;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
    return i;
  };
  ForEachInOrder(
      500, work, [&](int) { --num_results; }, 3, pool);
  EXPECT_LE(most, 3);
  EXPECT_EQ(num_results, 0);
}

TEST(ForEachInOrder, MergesOnTheThreadThatCallsIt) {
  ThreadPool pool(3);
  ForEachInOrder(
      100, [](int i) { return i; },
      [caller = std::this_thread::get_id()](int) { EXPECT_EQ(std::this_thread::get_id(), caller); }, 8, pool);
}

TEST(ForEachInOrder, WorksOnSeveralThreads) {
  ThreadPool pool(3);
  std::barrier all_there(4);  // Passed only if four calls of work are under way at once.
  ForEachInOrder(
      4, [&](int i) { return all_there.arrive_and_wait(), i; }, [](int) {}, 4, pool);
}

TEST(ForEachInOrder, NestedLoopsEnd) {
  for (const int num_workers : {0, 1, 3}) {
    ThreadPool pool(num_workers);
    const std::function<int(int)> num_leaves = [&](int depth) {
      if (depth == 0) return 1;
      int sum = 0;
      ForEachInOrder(
          5, [&](int) { return num_leaves(depth - 1); }, [&](int leaves) { sum += leaves; }, 8, pool);
      return sum;
    };
    EXPECT_EQ(num_leaves(4), 625);
  }
}

TEST(ForEachInOrder, NestedErrorsReachTheOuterLoop) {
  ThreadPool pool(3);
  const auto outer = [&](int i) {
    OnAllCores(
        10, [&](int64_t k) { DAUMIER_CHECK(i != 6 || k != 7, "number {} of {} fails", k, i); }, pool);
    return i;
  };
  testing::ExpectError(
      [&] {
        ForEachInOrder(
            20, outer, [](int) {}, 8, pool);
      },
      "number 7 of 6 fails");
}

TEST(ForEachInOrder, LoopsOfSeveralThreadsShareThePool) {
  ThreadPool pool(2);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int repeat = 0; repeat < 50; ++repeat) {
        int sum = 0;
        ForEachInOrder(
            20, [](int i) { return i; }, [&](int i) { sum += i; }, 8, pool);
        EXPECT_EQ(sum, 190);
      }
    });
  }
}

TEST(ForEachInOrder, ResultsMayBeMovableOnly) {
  ThreadPool pool(2);
  int sum = 0;
  ForEachInOrder(
      10, [](int i) { return std::make_unique<int>(i); }, [&](std::unique_ptr<int> i) { sum += *i; }, 8, pool);
  EXPECT_EQ(sum, 45);
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
  ThreadPool pool(5);
  std::vector<int> calls(1001);
  OnAllCores(
      1001, [&](int64_t i) { ++calls[static_cast<size_t>(i)]; }, pool);
  EXPECT_EQ(calls, std::vector<int>(1001, 1));
  testing::ExpectError([] { OnAllCores(3, [](int64_t i) { DAUMIER_CHECK(i != 1, "number {} fails", i); }); },
                       "number 1 fails");
}

}  // namespace
}  // namespace daumier
