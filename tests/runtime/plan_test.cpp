#include "runtime/plan.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace daumier::runtime {
namespace {

/// y = 2 x, then z = y + 1, of four numbers; x, y and z in buffers of their own.
std::unique_ptr<Plan> TwoSteps() {
  const Place x{.buffer = 0}, y{.buffer = 1}, z{.buffer = 2};
  std::vector<PlanStep> steps(2);
  steps[0] = {.node = "double", .kernel = "ours", .own = [=](Arena& arena) {
                for (int i = 0; i < 4; ++i) arena.At(y)[i] = 2 * arena.At(x)[i];
              }};
  steps[1] = {.node = "add", .kernel = "ours", .own = [=](Arena& arena) {
                for (int i = 0; i < 4; ++i) arena.At(z)[i] = arena.At(y)[i] + 1;
              }};
  return std::make_unique<Plan>(std::move(steps), std::vector<PlanPort>{{"x", {4}, x}},
                                std::vector<PlanPort>{{"z", {4}, z}},
                                std::vector<PlanBuffer>{{4, -1, 0}, {4, 0, 1}, {4, 1, 2}});
}

TEST(RuntimePlan, RunsItsStepsInOrder) {
  const std::unique_ptr<Plan> plan = TwoSteps();
  FloatArray x({4});
  x.values = {0, 1, 2, 3};
  EXPECT_EQ(plan->Run({{"x", x}}).at("z").values, (std::vector<float>{1, 3, 5, 7}));
  EXPECT_EQ(plan->steps().size(), 2u);
}

TEST(RuntimePlan, BuffersThatAreNotNeededTogetherShareMemory) {
  const std::vector<PlanBuffer> apart = {{1024, -1, 0}, {1024, 0, 1}, {1024, 1, 2}};
  const std::vector<PlanBuffer> together = {{1024, -1, 2}, {1024, 0, 2}, {1024, 1, 2}};
  const auto size_of = [](const std::vector<PlanBuffer>& buffers) { return Plan({}, {}, {}, buffers).arena_size(); };
  EXPECT_LT(size_of(apart), 3 * 1024);
  EXPECT_GE(size_of(together), 3 * 1024);
}

TEST(RuntimePlan, ThreadsHaveMemoryOfTheirOwn) {
  const std::unique_ptr<Plan> plan = TwoSteps();
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      FloatArray x({4});
      x.values.assign(4, float(t));
      for (int i = 0; i < 200; ++i)
        wrong += plan->Run({{"x", x}}).at("z").values != std::vector<float>(4, 2.0f * t + 1);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace daumier::runtime
