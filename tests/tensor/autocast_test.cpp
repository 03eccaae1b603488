#include "tensor/autocast.h"

#include <gtest/gtest.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

#include <cstdlib>

namespace daumier::tensor {
namespace {

TEST(Autocast, MultipliesInBfloat16AndKeepsWeightsAndGradientsInFloat32) {
  // LibTorch 1.13 chooses oneDNN's bfloat16 layers by the processor, and ignores the limit that oneDNN respects.
  if (std::getenv("ONEDNN_MAX_CPU_ISA") != nullptr) GTEST_SKIP() << "oneDNN is limited by ONEDNN_MAX_CPU_ISA";
  torch::manual_seed(1);
  torch::nn::Linear layer(64, 8);
  const torch::Tensor input = torch::randn({16, 64}), exact = layer->forward(input);
  torch::Tensor rounded;
  {
    const Autocast guard(torch::kCPU, true);
    rounded = layer->forward(input);
  }
  EXPECT_EQ(rounded.scalar_type(), torch::kBFloat16);
  const double error = (rounded - exact).norm().item<double>() / exact.norm().item<double>();
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1.0 / 128);  // Of 8 bits of mantissa.
  rounded.to(torch::kFloat32).sum().backward();
  EXPECT_EQ(layer->weight.scalar_type(), torch::kFloat32);
  EXPECT_EQ(layer->weight.grad().scalar_type(), torch::kFloat32);
}

TEST(Autocast, LeavesWhatItFound) {
  const torch::Tensor numbers = torch::randn({4, 4});
  const auto type = [&] { return torch::mm(numbers, numbers).scalar_type(); };
  EXPECT_EQ(type(), torch::kFloat32);
  EXPECT_FALSE(Autocast::IsOn(torch::kCPU));
  {
    const Autocast outer(torch::kCPU, true);
    EXPECT_EQ(type(), torch::kBFloat16);
    EXPECT_TRUE(Autocast::IsOn(torch::kCPU));
    {
      const Autocast inner(torch::kCPU, false);
      EXPECT_EQ(type(), torch::kFloat32);
    }
    EXPECT_EQ(type(), torch::kBFloat16);
  }
  EXPECT_EQ(type(), torch::kFloat32);
}

TEST(Autocast, SeesWeightsThatChangedSinceTheLastGuard) {
  torch::nn::Linear layer(torch::nn::LinearOptions(3, 1).bias(false));
  const torch::Tensor input = torch::ones({1, 3});
  for (const float weight : {1.0f, 2.0f}) {
    {
      const at::NoGradGuard no_grad;
      layer->weight.fill_(weight);
    }
    const Autocast guard(torch::kCPU, true);
    EXPECT_EQ(layer->forward(input).item<float>(), 3 * weight);
  }
}

}  // namespace
}  // namespace daumier::tensor
