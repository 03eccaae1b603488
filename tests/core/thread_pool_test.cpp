#include "core/thread_pool.h"

#include "core/runtime.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace daumier {
namespace {

TEST(ThreadPool, RunsEveryJobBeforeItIsDestroyed) {
  std::atomic<int> num_run = 0;
  {
    ThreadPool pool(3);
    for (int i = 0; i < 100; ++i) pool.Add([&] { ++num_run; });
  }
  EXPECT_EQ(num_run, 100);
}

TEST(ThreadPool, OneWorkerRunsJobsInTheirOrder) {
  std::vector<int> order;
  {
    ThreadPool pool(1);
    for (int i = 0; i < 10; ++i) pool.Add([&order, i] { order.push_back(i); });
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(ThreadPool, JobsAreAddedFromJobsAndFromSeveralThreads) {
  std::atomic<int> num_run = 0;
  {
    ThreadPool pool(2);
    std::latch first_half(50);
    std::vector<std::jthread> threads;
    for (int t = 0; t < 5; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 10; ++i) {
          pool.Add([&] {
            pool.Add([&] { ++num_run; });
            first_half.count_down();
          });
        }
      });
    }
    first_half.wait();
  }
  EXPECT_EQ(num_run, 50);
}

TEST(ThreadPool, TheSharedOneLeavesACoreToItsCaller) {
  EXPECT_EQ(SharedThreadPool().num_workers(), NumCores() - 1);
  EXPECT_EQ(&SharedThreadPool(), &SharedThreadPool());
}

}  // namespace
}  // namespace daumier
