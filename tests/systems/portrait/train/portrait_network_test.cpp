#include "systems/portrait/train/portrait_network.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::portrait {
namespace {

constexpr PortraitNetworkOptions kTinyNetwork{.depth = 18, .resolution = 32, .width = 8};

TEST(PortraitNetwork, IsAtFirstTheMeanFaceInItsUsualPose) {
  fitting::PortraitPose pose;
  pose << 0.1, -0.2, 0.3, 1, 2, -40;
  PortraitNetwork network(kTinyNetwork, faces::ExpressionWeights::kUnit, pose);
  const torch::Tensor x = network->forward(torch::rand({3, 3, 32, 32}));
  EXPECT_EQ(x.sizes(), (std::vector<int64_t>{3, faces::kNumCoefficients}));
  EXPECT_EQ(x.slice(1, 0, faces::kPoseSlot.first).abs().max().item<float>(), 0);
  for (int64_t k = 0; k < 6; ++k) EXPECT_FLOAT_EQ(x[2][faces::kPoseSlot.first + k].item<float>(), float(pose[k]));
}

TEST(PortraitNetwork, KeepsTheUsualPoseAmongItsWeights) {
  const PortraitNetwork network(kTinyNetwork, faces::ExpressionWeights::kUnit);
  EXPECT_TRUE(network->named_buffers().contains("usual_pose"));
  EXPECT_EQ(network->usual_pose().numel(), 6);
  int64_t count = 0;
  for (const torch::Tensor& parameter : network->parameters()) count += parameter.numel();
  EXPECT_EQ(network->num_parameters(), count);
}

TEST(PortraitNetwork, RefusesAResolutionThatIsNoMultipleOf32) {
  testing::ExpectError(
      [] {
        PortraitNetwork(PortraitNetworkOptions{.depth = 18, .resolution = 48, .width = 8},
                        faces::ExpressionWeights::kUnit);
      },
      "48");
}

}  // namespace
}  // namespace daumier::portrait
