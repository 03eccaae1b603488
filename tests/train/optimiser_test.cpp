#include "train/optimiser.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/nn.h>
#include <torch/optim/adamw.h>

namespace daumier::train {
namespace {

OptimiserOptions WithWarmUp(double warm_up) {
  OptimiserOptions options;
  options.learning_rate = 0.1;
  options.warm_up = warm_up;
  options.final_rate = 0.2;
  return options;
}

TEST(LearningRate, ClimbsLinearlyThenFallsByACosine) {
  const OptimiserOptions options = WithWarmUp(0.2);
  EXPECT_NEAR(LearningRate(options, 0, 20), 0.025, 1e-12);
  EXPECT_NEAR(LearningRate(options, 3, 20), 0.1, 1e-12);
  EXPECT_NEAR(LearningRate(options, 4, 20), 0.1, 1e-12);
  EXPECT_NEAR(LearningRate(options, 12, 20), 0.06, 1e-12);
  for (int step = 5; step < 20; ++step) EXPECT_LT(LearningRate(options, step, 20), LearningRate(options, step - 1, 20));
  EXPECT_GT(LearningRate(options, 19, 20), 0.02);
}

TEST(LearningRate, WithoutWarmUpBeginsAtThePeakAndAllWarmUpEndsThere) {
  EXPECT_NEAR(LearningRate(WithWarmUp(0), 0, 10), 0.1, 1e-12);
  EXPECT_NEAR(LearningRate(WithWarmUp(1), 9, 10), 0.1, 1e-12);
}

TEST(AdamW, MovesByTheRateAgainstTheSignInItsFirstStep) {
  torch::nn::Linear linear(1, 2);
  OptimiserOptions options;
  options.weight_decay = 0;
  AdamW optimiser(*linear, options);
  const torch::Tensor before = linear->bias.detach().clone();
  (linear->bias * torch::tensor({3.0f, -0.01f})).sum().backward();
  EXPECT_NEAR(optimiser.GradientNorm(), std::sqrt(9 + 0.0001), 1e-6);
  optimiser.Step(0.5);
  EXPECT_TRUE(torch::allclose(linear->bias.detach() - before, torch::tensor({-0.5f, 0.5f}), 1e-4));
}

TEST(AdamW, DecaysWeightsButNotBiases) {
  torch::nn::Linear linear(2, 2);
  OptimiserOptions options;
  options.weight_decay = 0.1;
  AdamW optimiser(*linear, options);
  const torch::Tensor weight = linear->weight.detach().clone(), bias = linear->bias.detach().clone();
  ((linear->weight.sum() + linear->bias.sum()) * 0).backward();
  optimiser.Step(0.5);
  EXPECT_TRUE(torch::allclose(linear->weight, weight * 0.95));
  EXPECT_TRUE(torch::equal(linear->bias, bias));
}

TEST(AdamW, AgreesWithLibTorchWhereAllParametersDecay) {
  torch::manual_seed(3);
  torch::nn::Linear ours(torch::nn::LinearOptions(4, 3).bias(false));
  torch::nn::Linear theirs(torch::nn::LinearOptions(4, 3).bias(false));
  {
    torch::NoGradGuard no_grad;
    theirs->weight.copy_(ours->weight);
  }
  OptimiserOptions options;
  options.weight_decay = 0.05;
  AdamW optimiser(*ours, options);
  torch::optim::AdamW reference(theirs->parameters(), torch::optim::AdamWOptions(0.01).weight_decay(0.05));
  for (int step = 0; step < 20; ++step) {
    const torch::Tensor input = torch::randn({8, 4});
    for (const auto& linear : {ours, theirs}) {
      torch::nn::Linear network = linear;
      network->zero_grad();
      network(input).tanh().square().sum().backward();
    }
    optimiser.Step(0.01);
    reference.step();
  }
  EXPECT_TRUE(torch::allclose(ours->weight, theirs->weight, 1e-5, 1e-6));
}

TEST(AdamW, ScalesAndClearsGradients) {
  torch::nn::Linear linear(1, 1);
  AdamW optimiser(*linear, {});
  (linear->bias * 4).sum().backward();
  optimiser.ScaleGradients(0.25);
  EXPECT_EQ(linear->bias.grad().item<float>(), 1.0f);
  optimiser.ZeroGradients();
  EXPECT_FALSE(linear->bias.grad().defined());
}

TEST(AdamW, RefusesAStateOfAnotherNetwork) {
  torch::nn::Linear small(1, 1), large(2, 2);
  AdamW optimiser(*small, {});
  testing::ExpectError([&] { optimiser.LoadState(AdamW(*large, {}).State(), "FILE"); }, "FILE");
  testing::ExpectError([&] { optimiser.LoadState({}, "FILE"); }, "has no optimiser state");
}

}  // namespace
}  // namespace daumier::train
