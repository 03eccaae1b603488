#include "train/sample_order.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace daumier::train {
namespace {

TEST(SampleOrder, EachEpochHasEverySampleAtMostOnceInAnotherOrder) {
  const SampleOrder order(3, 20, 6, 1);
  ASSERT_EQ(order.steps_per_epoch(), 3);
  std::vector<std::vector<int>> epochs(2);
  for (int64_t step = 0; step < 6; ++step)
    for (const int sample : order.Batch(step)) epochs[size_t(order.Epoch(step))].push_back(sample);
  EXPECT_NE(epochs[0], epochs[1]);
  for (const auto& epoch : epochs) EXPECT_EQ(std::set<int>(epoch.begin(), epoch.end()).size(), 18u);
}

TEST(SampleOrder, AStepOfSeveralBatchesHasTheSamplesOfOneLargeBatch) {
  const SampleOrder large(3, 20, 6, 1), several(3, 20, 2, 3);
  ASSERT_EQ(several.steps_per_epoch(), 3);
  for (int64_t step = 0; step < 7; ++step) {
    EXPECT_EQ(several.Step(step), large.Batch(step));
    std::vector<int> joined;
    for (int64_t index = 3 * step; index < 3 * step + 3; ++index)
      for (const int sample : several.Batch(index)) joined.push_back(sample);
    EXPECT_EQ(joined, large.Step(step));
  }
}

TEST(SampleOrder, IsAFunctionOfSeedAndStepFromSeveralThreads) {
  const SampleOrder order(3, 100, 7, 2), again(3, 100, 7, 2), other(4, 100, 7, 2);
  std::vector<std::vector<int>> batches(60);
  {
    std::vector<std::jthread> threads;
    for (size_t t = 0; t < 3; ++t)
      threads.emplace_back([&, t] {
        for (size_t i = t; i < batches.size(); i += 3) batches[i] = order.Batch(int64_t(i));
      });
  }
  for (size_t i = 0; i < batches.size(); ++i) EXPECT_EQ(batches[i], again.Batch(int64_t(i)));
  EXPECT_NE(batches[0], other.Batch(0));
}

TEST(SampleOrder, ABatchHasNoMoreSamplesThanThereAreAndAStepMayNot) {
  EXPECT_EQ(SampleOrder(3, 5, 32, 1).Batch(0).size(), 5u);
  testing::ExpectError([] { SampleOrder(3, 5, 2, 3); }, "more than the 5 training samples");
  testing::ExpectError([] { SampleOrder(3, 0, 2, 1); }, "no training sample");
}

}  // namespace
}  // namespace daumier::train
