#include "models/pooled_trunk.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::models {
namespace {

int64_t Count(const torch::nn::Sequential& layers) {
  int64_t count = 0;
  for (const torch::Tensor& parameter : layers->parameters()) count += parameter.numel();
  return count;
}

TEST(PooledTrunk, HasTheParametersCountedByHandAtEveryResolution) {
  for (const int resolution : {32, 50, 128}) {
    const SketchTrunk trunk = PooledTrunk({.kind = "pooled", .resolution = resolution, .width = 8, .hidden = 10});
    EXPECT_EQ(Count(trunk.convolutions), 9 * (8 + 8 * 16 + 16 * 32) + 2 * (8 + 16 + 32));
    EXPECT_EQ(Count(trunk.features), (32 + 1) * 10);
  }
}

TEST(PooledTrunk, TurnsASketchIntoFeatures) {
  SketchTrunk trunk = PooledTrunk({.kind = "pooled", .resolution = 50, .width = 8, .hidden = 10});
  const torch::Tensor features = trunk.features->forward(trunk.convolutions->forward(torch::rand({2, 1, 50, 50})));
  EXPECT_EQ(features.sizes().vec(), (std::vector<int64_t>{2, 10}));
}

}  // namespace
}  // namespace daumier::models
