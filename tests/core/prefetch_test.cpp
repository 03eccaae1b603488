#include "core/prefetch.h"

#include "core/parallel.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>

namespace daumier {
namespace {

void WaitUntil(const std::function<bool()>& condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::microseconds(100));
}

TEST(Prefetcher, GivesTheItemsInOrderWhateverTheThreads) {
  for (const int num_threads : {1, 2, 5}) {
    for (const int depth : {1, 2, 7}) {
      Prefetcher<std::unique_ptr<int64_t>> squares(
          3, 300, [](int64_t i) { return std::make_unique<int64_t>(i * i); }, depth, num_threads);
      for (int64_t i = 3; i < 300; ++i) ASSERT_EQ(*squares.Next(), i * i) << num_threads << " " << depth;
    }
  }
}

TEST(Prefetcher, ComputesEachItemOnce) {
  std::vector<std::atomic<int>> calls(200);
  Prefetcher<int> items(
      0, 200, [&](int64_t i) { return ++calls[size_t(i)]; }, 4, 3);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(items.Next(), 1);
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST(Prefetcher, ComputesAheadOfUseButNoFurtherThanItsDepth) {
  std::atomic<int> begun = 0;
  Prefetcher<int> items(
      0, 100, [&](int64_t) { return ++begun; }, 3, 2);
  WaitUntil([&] { return begun == 3; });
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(begun, 3);
  items.Next();
  WaitUntil([&] { return begun == 4; });
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(begun, 4);
}

TEST(Prefetcher, ThrowsTheErrorOfAnItemWhereTheItemIsTakenAndNotBefore) {
  Prefetcher<int> items(
      0, 10,
      [](int64_t i) {
        if (i == 2 || i == 3) throw std::runtime_error("item " + std::to_string(i));
        return int(i);
      },
      4, 2);
  EXPECT_EQ(items.Next(), 0);
  EXPECT_EQ(items.Next(), 1);
  for (const char* expected : {"item 2", "item 3"}) {
    try {
      items.Next();
      ADD_FAILURE() << expected;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), expected);
    }
  }
  for (int i = 4; i < 10; ++i) EXPECT_EQ(items.Next(), i);
  testing::ExpectError([&] { items.Next(); }, "item 10 requested, expected 0 .. 9");
}

TEST(Prefetcher, StopsWithoutTheItemsThatHaveNotBegun) {
  std::atomic<int> begun = 0;
  {
    Prefetcher<int> items(
        0, 1'000'000,
        [&](int64_t) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return ++begun;
        },
        8, 2);
    items.Next();
  }
  EXPECT_LE(begun, 10);
  const int begun_at_the_end = begun;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(begun, begun_at_the_end);
}

TEST(Prefetcher, ItemsAreMadeOnThePoolWhileTheCallerUsesItToo) {
  Prefetcher<int64_t> sums(
      0, 60,
      [](int64_t i) {
        std::vector<int64_t> values(40);
        OnAllCores(40, [&](int64_t k) { values[size_t(k)] = i * k; });
        int64_t sum = 0;
        for (const int64_t value : values) sum += value;
        return sum;
      },
      3, 2);
  for (int64_t i = 0; i < 60; ++i) {
    std::vector<int64_t> own(40);
    OnAllCores(40, [&](int64_t k) { own[size_t(k)] = k; });
    EXPECT_EQ(sums.Next(), i * 780);
    EXPECT_EQ(own[39], 39);
  }
}

TEST(Prefetcher, NeedsADepthAndAThread) {
  testing::ExpectError(
      [] {
        Prefetcher<int>(
            0, 1, [](int64_t) { return 0; }, 0, 1);
      },
      "0 items by 1 threads");
  testing::ExpectError(
      [] {
        Prefetcher<int>(
            0, 1, [](int64_t) { return 0; }, 1, 0);
      },
      "1 items by 0 threads");
}

}  // namespace
}  // namespace daumier
