#include "train/random_state.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::train {
namespace {

TEST(RandomState, RestoredDrawsAreTheSame) {
  torch::manual_seed(4);
  const tensor::NamedTensors state = RandomState(torch::kCPU);
  EXPECT_EQ(state.size(), 1u);
  const torch::Tensor drawn = torch::rand({5});
  LoadRandomState(state, torch::kCPU, "FILE");
  EXPECT_TRUE(torch::equal(torch::rand({5}), drawn));
}

TEST(RandomState, SkipsTheStateOfADeviceThatIsNotUsedAndKeepsAGeneratorWithoutState) {
  torch::manual_seed(4);
  tensor::NamedTensors state = RandomState(torch::kCPU);
  state["cuda:0"] = torch::zeros({16}, torch::kUInt8);
  const torch::Tensor drawn = torch::rand({5});
  LoadRandomState(state, torch::kCPU, "FILE");
  EXPECT_TRUE(torch::equal(torch::rand({5}), drawn));
  torch::manual_seed(4);
  state.erase("cpu");
  LoadRandomState(state, torch::kCPU, "FILE");
  EXPECT_TRUE(torch::equal(torch::rand({5}), drawn));
}

TEST(RandomState, RefusesAStateThatDoesNotFit) {
  testing::ExpectError(
      [] {
        LoadRandomState({{"cpu", torch::zeros({3}, torch::kUInt8)}}, torch::kCPU, "FILE");
      },
      "FILE: the random state of cpu");
}

}  // namespace
}  // namespace daumier::train
