#include "train/adamw.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::train {
namespace {

AdamWUpdate Random(const std::vector<int64_t>& shape, double decay) {
  return {.factors = {.beta1 = 0.9, .beta2 = 0.999, .decay = decay, .root_correction = 0.0836, .step_size = 5.75e-3},
          .parameter = torch::randn(shape),
          .gradient = torch::randn(shape),
          .mean = torch::randn(shape),
          .square = torch::rand(shape)};
}

AdamWUpdate Copy(const AdamWUpdate& update) {
  return {update.factors, update.parameter.clone(), update.gradient.clone(), update.mean.clone(),
          update.square.clone()};
}

void ExpectSameBytes(const AdamWUpdate& a, const AdamWUpdate& b) {
  EXPECT_TRUE(torch::equal(a.parameter, b.parameter));
  EXPECT_TRUE(torch::equal(a.mean, b.mean));
  EXPECT_TRUE(torch::equal(a.square, b.square));
}

TEST(AdamWUpdate, IsTheFormulaOfOneNumberWorkedOutByHand) {
  // m = 0.5 * 2 + 0.5 * 4 = 3, v = 0.75 * 4 + 0.25 * 16 = 7; p = 0.5 * 8 - 2 * 3 / (sqrt(7) / 2).
  for (const auto update : {UpdateAdamWByTensors, +[](const AdamWUpdate& one) { UpdateAdamW({one}); }}) {
    const AdamWUpdate one{.factors = {.beta1 = 0.5, .beta2 = 0.75, .decay = 0.5, .root_correction = 2, .step_size = 2},
                          .parameter = torch::full({1}, 8.0f),
                          .gradient = torch::full({1}, 4.0f),
                          .mean = torch::full({1}, 2.0f),
                          .square = torch::full({1}, 4.0f)};
    update(one);
    EXPECT_EQ(one.mean.item<float>(), 3);
    EXPECT_EQ(one.square.item<float>(), 7);
    EXPECT_NEAR(one.parameter.item<float>(), 4 - 6 / (std::sqrt(7.0) / 2), 1e-6);
  }
}

TEST(AdamWUpdate, HasTheBytesOfTensorOperations) {
  torch::manual_seed(8);
  std::vector<AdamWUpdate> fast, slow;
  for (const int64_t count : {1, 7, 8, 15, 16, 17, 33, 8192, 8193, 50001})
    for (const double decay : {1.0, 0.99997}) fast.push_back(Random({count}, decay));
  for (int step = 0; step < 3; ++step) {
    slow.clear();
    for (const AdamWUpdate& update : fast) slow.push_back(Copy(update));
    UpdateAdamW(fast);
    for (size_t i = 0; i < fast.size(); ++i) {
      SCOPED_TRACE(fast[i].parameter.numel());
      UpdateAdamWByTensors(slow[i]);
      ExpectSameBytes(fast[i], slow[i]);
    }
  }
}

TEST(AdamWUpdate, HasTheSameNumbersInEveryLayout) {
  torch::manual_seed(8);
  const auto last = torch::MemoryFormat::ChannelsLast;
  const AdamWUpdate plain = Random({6, 5, 3, 3}, 0.99997);
  AdamWUpdate mixed = Copy(plain), channels_last = Copy(plain), strided = Copy(plain);
  mixed.gradient = mixed.gradient.contiguous(last);
  for (torch::Tensor* tensor : {&channels_last.parameter, &channels_last.mean, &channels_last.square})
    *tensor = tensor->contiguous(last);
  strided.parameter = torch::cat({plain.parameter, plain.parameter}).slice(0, 0, 12, 2).copy_(plain.parameter);
  UpdateAdamW({plain, mixed, channels_last, strided});
  for (const AdamWUpdate& other : {mixed, channels_last, strided}) ExpectSameBytes(other, plain);
}

TEST(AdamWUpdate, UpdatesWhatTheKernelDoesNot) {
  torch::manual_seed(8);
  AdamWUpdate update = Random({9}, 0.9);
  for (torch::Tensor* tensor : {&update.parameter, &update.gradient, &update.mean, &update.square})
    *tensor = tensor->to(torch::kFloat64);
  const AdamWUpdate slow = Copy(update);
  UpdateAdamW({update});
  UpdateAdamWByTensors(slow);
  ExpectSameBytes(update, slow);
}

}  // namespace
}  // namespace daumier::train
