#include "models/residual_network.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/nn/modules/conv.h>
#include <torch/utils.h>

namespace daumier::models {
namespace {

TEST(ResidualNetwork, Of50LayersHasTheParametersOfThePublishedOne) {
  // torchvision's resnet50 without its 1000 classes has 23,508,032; the head has 2048 * 239 + 239.
  const ResidualNetwork network(ResidualNetworkOptions{});
  EXPECT_EQ(network->num_parameters(), 23'508'032 + 2048 * 239 + 239);
}

TEST(ResidualNetwork, Of18LayersHasTheParametersOfThePublishedOne) {
  const ResidualNetwork network(ResidualNetworkOptions{.depth = 18});
  EXPECT_EQ(network->num_parameters(), 11'176'512 + 512 * 239 + 239);
}

TEST(ResidualNetwork, IsZeroForEveryPictureAtFirst) {
  torch::manual_seed(1);
  for (const int depth : {18, 50}) {
    ResidualNetwork network(ResidualNetworkOptions{.depth = depth, .resolution = 64, .width = 8});
    const torch::Tensor outputs = network->forward(torch::rand({2, 3, 64, 64}));
    EXPECT_EQ(outputs.sizes(), (std::vector<int64_t>{2, 239}));
    EXPECT_EQ(outputs.abs().max().item<float>(), 0);
    EXPECT_EQ(network->Features(torch::rand({1, 3, 64, 64})).size(1), depth == 18 ? 64 : 256);
  }
}

TEST(ResidualNetwork, HalvesTheSideInTheThreeByThreeConvolution) {
  // v1.5: of the second stage's first bottleneck only the 3 x 3 convolution and the short cut have stride 2.
  const ResidualNetwork network(ResidualNetworkOptions{.resolution = 64, .width = 8});
  for (const auto& module : network->named_modules()) {
    const auto* convolution = module.value()->as<torch::nn::Conv2d>();
    if (convolution == nullptr || module.key().find("stages.3.residual") == std::string::npos) continue;
    const bool is_middle = convolution->weight.size(2) == 3;
    EXPECT_EQ(convolution->options.stride()->at(0), is_middle ? 2 : 1) << module.key();
  }
}

TEST(ResidualNetwork, EveryWeightLearnsAfterTheHeadHasMoved) {
  torch::manual_seed(2);
  ResidualNetwork network(ResidualNetworkOptions{.depth = 18, .resolution = 32, .width = 8, .outputs = 3});
  {
    const torch::NoGradGuard no_grad;
    for (auto& item : network->named_parameters())
      if (item.key().find("head") != std::string::npos || item.value().abs().max().item<float>() == 0)
        item.value().normal_();
  }
  network->forward(torch::rand({4, 3, 32, 32})).square().sum().backward();
  for (const auto& item : network->named_parameters())
    EXPECT_GT(item.value().grad().abs().max().item<float>(), 0) << item.key();
}

TEST(ResidualNetwork, RefusesOtherShapes) {
  testing::ExpectError([] { ResidualNetwork(ResidualNetworkOptions{.depth = 34}); }, "expected 18 or 50");
  testing::ExpectError([] { ResidualNetwork(ResidualNetworkOptions{.resolution = 100}); }, "a multiple of 32");
  ResidualNetwork network(ResidualNetworkOptions{.depth = 18, .resolution = 64, .width = 8});
  testing::ExpectError([&] { network->forward(torch::rand({1, 3, 32, 32})); }, "pictures has shape");
}

}  // namespace
}  // namespace daumier::models
