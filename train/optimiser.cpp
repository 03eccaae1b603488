#include "train/optimiser.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"
#include "train/adamw.h"
#include "train/gradient_norm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::train {

double LearningRate(const OptimiserOptions& options, int64_t step, int64_t total_steps) {
  const double warm_up_steps = std::ceil(options.warm_up * double(total_steps));
  if (double(step) < warm_up_steps) return options.learning_rate * double(step + 1) / warm_up_steps;
  const double progress = (double(step) - warm_up_steps) / (double(total_steps) - warm_up_steps);
  const double cosine = 0.5 * (1 + std::cos(std::numbers::pi * progress));
  return options.learning_rate * (options.final_rate + (1 - options.final_rate) * cosine);
}

Optimiser::Optimiser(torch::nn::Module& module, const OptimiserOptions& options,
                     const std::vector<ParameterGroup>& groups)
    : options_(options), num_steps_(torch::zeros({1}, torch::kInt64)) {
  std::vector<bool> is_used(groups.size());
  for (const auto& item : module.named_parameters()) {
    if (!item.value().requires_grad()) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const ParameterGroup& candidate) {
      return item.key().starts_with(candidate.prefix);
    });
    Slot slot{item.key(), item.value(),        torch::zeros_like(item.value()), torch::zeros_like(item.value()),
              /*rate=*/1, options.weight_decay};
    if (group != groups.end()) {
      is_used[size_t(group - groups.begin())] = true;
      slot.rate = group->rate;
      slot.weight_decay = group->weight_decay.value_or(options.weight_decay);
    }
    if (slot.parameter.dim() <= 1) slot.weight_decay = 0;
    slots_.push_back(std::move(slot));
  }
  DAUMIER_CHECK(!slots_.empty(), "the network has no parameter to train");
  for (size_t i = 0; i < groups.size(); ++i)
    DAUMIER_CHECK(is_used[i], "no trained parameter is in the group '{}'", groups[i].prefix);
}

void Optimiser::ZeroGradients() {
  for (Slot& slot : slots_) slot.parameter.mutable_grad() = torch::Tensor();
}

torch::Tensor Optimiser::GradientNorm() const {
  std::vector<torch::Tensor> gradients;
  for (const Slot& slot : slots_)
    if (slot.parameter.grad().defined()) gradients.push_back(slot.parameter.grad());
  return train::GradientNorm(gradients);
}

void Optimiser::ClipGradients(const torch::Tensor& norm, double clip_norm) {
  const at::NoGradGuard no_grad;
  const torch::Tensor factor = (clip_norm / norm).clamp_max(1);
  for (Slot& slot : slots_)
    if (slot.parameter.grad().defined()) slot.parameter.mutable_grad().mul_(factor);
}

void Optimiser::Step(double learning_rate) {
  const at::NoGradGuard no_grad;
  num_steps_ += 1;
  if (options_.kind == "sgd") {
    for (Slot& slot : slots_)
      if (slot.parameter.grad().defined()) StepSgd(slot, learning_rate * slot.rate);
  } else {
    StepAdamW(learning_rate);
  }
}

void Optimiser::StepAdamW(double learning_rate) {
  const double t = double(num_steps_.item<int64_t>());
  const double mean_correction = 1 - std::pow(options_.beta1, t);
  const double square_correction = 1 - std::pow(options_.beta2, t);
  std::vector<AdamWUpdate> updates;
  for (Slot& slot : slots_) {
    if (!slot.parameter.grad().defined()) continue;
    const double rate = learning_rate * slot.rate;
    updates.push_back({.factors = {.beta1 = options_.beta1,
                                   .beta2 = options_.beta2,
                                   .decay = 1 - rate * slot.weight_decay,
                                   .root_correction = std::sqrt(square_correction),
                                   .step_size = rate / mean_correction},
                       .parameter = slot.parameter,
                       .gradient = slot.parameter.grad(),
                       .mean = slot.mean,
                       .square = slot.square});
  }
  UpdateAdamW(updates);
}

void Optimiser::StepSgd(Slot& slot, double rate) const {
  slot.mean.mul_(options_.beta1).add_(slot.parameter.grad(), rate);
  if (slot.weight_decay != 0) slot.mean.add_(slot.parameter, rate * slot.weight_decay);
  slot.parameter.sub_(slot.mean);
}

void Optimiser::Reset() {
  const at::NoGradGuard no_grad;
  num_steps_.zero_();
  for (Slot& slot : slots_) {
    slot.mean.zero_();
    slot.square.zero_();
  }
}

tensor::NamedTensors Optimiser::State() const {
  tensor::NamedTensors state{{"num_steps", num_steps_}};
  for (const Slot& slot : slots_) {
    state["mean." + slot.name] = slot.mean;
    state["square." + slot.name] = slot.square;
  }
  return state;
}

void Optimiser::LoadState(const tensor::NamedTensors& state, const std::string& where) {
  const at::NoGradGuard no_grad;
  for (auto& [name, target] : State()) {
    const auto found = state.find(name);
    DAUMIER_CHECK(found != state.end(), "{} has no optimiser state {}: is it of another network?", where, name);
    tensor::CheckShape(found->second, target.sizes(), where + ": " + name);
  }
  for (auto& [name, target] : State()) target.copy_(state.at(name));
}

}  // namespace daumier::train
