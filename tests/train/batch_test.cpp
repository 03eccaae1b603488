#include "train/batch.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::train {
namespace {

TEST(Batch, IsTheSamplesArraysAndIndicesAsTensors) {
  SampleBatch samples{.samples = {4, 1}, .arrays = {}, .indices = {}};
  samples.arrays["points"] = FloatArray({2, 3}, {1, 2, 3, 4, 5, 6});
  samples.indices["faces"] = Array<int64_t>({2}, {7, 9});
  const Batch batch = ToDevice(std::move(samples), torch::kCPU);
  EXPECT_TRUE(torch::equal(batch.samples, torch::tensor({4, 1}, torch::kInt64)));
  EXPECT_TRUE(torch::equal(batch.at("points"), torch::tensor({{1.0f, 2.0f, 3.0f}, {4.0f, 5.0f, 6.0f}})));
  EXPECT_TRUE(torch::equal(batch.at("faces"), torch::tensor({7, 9}, torch::kInt64)));
  EXPECT_FALSE(batch.find("images").defined());
  testing::ExpectError([&] { batch.at("images"); }, "no tensor 'images'");
}

}  // namespace
}  // namespace daumier::train
