#include "train/optimiser.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/nn/modules/linear.h>
#include <torch/optim.h>
#include <torch/optim/adamw.h>
#include <torch/utils.h>

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
  Optimiser optimiser(*linear, options);
  const torch::Tensor before = linear->bias.detach().clone();
  (linear->bias * torch::tensor({3.0f, -0.01f})).sum().backward();
  EXPECT_NEAR(optimiser.GradientNorm().item<double>(), std::sqrt(9 + 0.0001), 1e-6);
  optimiser.Step(0.5);
  EXPECT_TRUE(torch::allclose(linear->bias.detach() - before, torch::tensor({-0.5f, 0.5f}), 1e-4));
}

TEST(AdamW, DecaysWeightsButNotBiases) {
  torch::nn::Linear linear(2, 2);
  OptimiserOptions options;
  options.weight_decay = 0.1;
  Optimiser optimiser(*linear, options);
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
  Optimiser optimiser(*ours, options);
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

TEST(Sgd, FollowsCaffesRuleWorkedOutByHand) {
  // Weight 2, gradient 3 in both steps, rate 0.1, decay 0.5, momentum 0.9:
  //   m1 = 0.1 (3 + 1) = 0.4, w1 = 1.6; m2 = 0.36 + 0.1 (3 + 0.8) = 0.74, w2 = 0.86. The bias does not decay:
  //   m1 = 0.3, m2 = 0.57.
  torch::nn::Linear linear(1, 1);
  {
    torch::NoGradGuard no_grad;
    linear->weight.fill_(2);
    linear->bias.fill_(1);
  }
  OptimiserOptions options;
  options.kind = "sgd";
  options.weight_decay = 0.5;
  Optimiser optimiser(*linear, options);
  for (int step = 0; step < 2; ++step) {
    optimiser.ZeroGradients();
    (3 * linear->weight.sum() + 3 * linear->bias.sum()).backward();
    optimiser.Step(0.1);
  }
  EXPECT_NEAR(linear->weight.item<float>(), 0.86, 1e-6);
  EXPECT_NEAR(linear->bias.item<float>(), 1 - 0.87, 1e-6);
}

TEST(Optimiser, ResetForgetsThePast) {
  torch::manual_seed(4);
  torch::nn::Linear linear(2, 2), fresh(2, 2);
  for (const char* kind : {"adamw", "sgd"}) {
    OptimiserOptions options;
    options.kind = kind;
    Optimiser used(*linear, options), unused(*fresh, options);
    const auto step = [](Optimiser& optimiser, torch::nn::Linear& layer, float gradient) {
      optimiser.ZeroGradients();
      (gradient * layer->bias.sum()).backward();
      optimiser.Step(0.1);
    };
    step(used, linear, 5);
    used.Reset();
    {
      torch::NoGradGuard no_grad;
      fresh->bias.copy_(linear->bias);
    }
    step(used, linear, -1);
    step(unused, fresh, -1);
    EXPECT_TRUE(torch::equal(linear->bias, fresh->bias)) << kind;
  }
}

TEST(Optimiser, LeavesParametersWithoutAGradientAlone) {
  torch::nn::Linear linear(2, 2);
  OptimiserOptions options;
  options.weight_decay = 0.1;
  Optimiser optimiser(*linear, options);
  const torch::Tensor weight = linear->weight.detach().clone();
  linear->bias.sum().backward();
  optimiser.Step(0.5);
  EXPECT_TRUE(torch::equal(linear->weight, weight));
}

TEST(Optimiser, ClipsGradientsThatAreTooLongAndClearsThem) {
  torch::nn::Linear linear(1, 1);
  Optimiser optimiser(*linear, {});
  (linear->bias * 4).sum().backward();
  optimiser.ClipGradients(optimiser.GradientNorm(), 5);
  EXPECT_EQ(linear->bias.grad().item<float>(), 4.0f);
  optimiser.ClipGradients(optimiser.GradientNorm(), 1);
  EXPECT_EQ(linear->bias.grad().item<float>(), 1.0f);
  optimiser.ZeroGradients();
  EXPECT_FALSE(linear->bias.grad().defined());
}

TEST(Optimiser, GroupsHaveTheirOwnRateAndDecay) {
  for (const char* kind : {"adamw", "sgd"}) {
    torch::nn::Linear linear(2, 2), halved(2, 2);
    {
      torch::NoGradGuard no_grad;
      halved->weight.copy_(linear->weight);
      halved->bias.copy_(linear->bias);
    }
    OptimiserOptions options;
    options.kind = kind;
    options.weight_decay = 0.1;
    Optimiser grouped(*linear, options, {{.prefix = "weight", .rate = 0.5}, {.prefix = "b", .rate = 0}}),
        whole(*halved, options);
    const torch::Tensor bias = linear->bias.detach().clone();
    for (const auto& layer : {linear, halved}) (layer->weight.square().sum() + layer->bias.sum()).backward();
    grouped.Step(0.5);
    whole.Step(0.25);
    EXPECT_TRUE(torch::equal(linear->weight, halved->weight)) << kind;
    EXPECT_TRUE(torch::equal(linear->bias, bias)) << kind;
    Optimiser undecayed(*linear, options, {{.prefix = "weight", .weight_decay = 0}});
    const torch::Tensor weight = linear->weight.detach().clone();
    undecayed.ZeroGradients();
    (linear->weight * 0).sum().backward();
    undecayed.Step(0.5);
    EXPECT_TRUE(torch::equal(linear->weight, weight)) << kind;
  }
}

TEST(Optimiser, RefusesAGroupWithoutParameters) {
  torch::nn::Linear linear(1, 1);
  testing::ExpectError([&] { Optimiser(*linear, {}, {{.prefix = "trunk."}}); }, "group 'trunk.'");
}

TEST(AdamW, RefusesAStateOfAnotherNetwork) {
  torch::nn::Linear small(1, 1), large(2, 2);
  Optimiser optimiser(*small, {});
  testing::ExpectError([&] { optimiser.LoadState(Optimiser(*large, {}).State(), "FILE"); }, "FILE");
  testing::ExpectError([&] { optimiser.LoadState({}, "FILE"); }, "has no optimiser state");
}

}  // namespace
}  // namespace daumier::train
