#include "train/optimiser.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/Parallel.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::train {
namespace {

/// Calls work(begin, end) for parts of `count` numbers that a processor's cache holds, so that a chain of elementwise
/// operations reads and writes the memory once.
template <class Work>
void ForEachPart(int64_t count, const torch::Device& device, const Work& work) {
  constexpr int64_t kPart = 32768;
  if (!device.is_cpu()) return work(0, count);
  at::parallel_for(0, (count + kPart - 1) / kPart, 1, [&](int64_t first, int64_t last) {
    const at::NoGradGuard no_grad;  // Holds for one thread alone.
    for (int64_t i = first; i < last; ++i) work(i * kPart, std::min(count, (i + 1) * kPart));
  });
}

}  // namespace

double LearningRate(const OptimiserOptions& options, int64_t step, int64_t total_steps) {
  const double warm_up_steps = std::ceil(options.warm_up * double(total_steps));
  if (double(step) < warm_up_steps) return options.learning_rate * double(step + 1) / warm_up_steps;
  const double progress = (double(step) - warm_up_steps) / (double(total_steps) - warm_up_steps);
  const double cosine = 0.5 * (1 + std::cos(std::numbers::pi * progress));
  return options.learning_rate * (options.final_rate + (1 - options.final_rate) * cosine);
}

Optimiser::Optimiser(torch::nn::Module& module, const OptimiserOptions& options)
    : options_(options), num_steps_(torch::zeros({1}, torch::kInt64)) {
  for (const auto& item : module.named_parameters()) {
    if (!item.value().requires_grad()) continue;
    slots_.push_back({item.key(), item.value(), torch::zeros_like(item.value()), torch::zeros_like(item.value())});
  }
  DAUMIER_CHECK(!slots_.empty(), "the network has no parameter to train");
}

void Optimiser::ZeroGradients() {
  for (Slot& slot : slots_) slot.parameter.mutable_grad() = torch::Tensor();
}

double Optimiser::GradientNorm() const {
  const at::NoGradGuard no_grad;
  torch::Tensor sum = torch::zeros({}, slots_.front().parameter.options().dtype(torch::kFloat64));
  for (const Slot& slot : slots_)
    if (slot.parameter.grad().defined()) sum += slot.parameter.grad().norm().to(torch::kFloat64).square();
  return std::sqrt(sum.item<double>());
}

void Optimiser::ScaleGradients(double factor) {
  const at::NoGradGuard no_grad;
  for (Slot& slot : slots_)
    if (slot.parameter.grad().defined()) slot.parameter.mutable_grad().mul_(factor);
}

void Optimiser::Step(double learning_rate) {
  const at::NoGradGuard no_grad;
  num_steps_ += 1;
  for (Slot& slot : slots_) {
    if (!slot.parameter.grad().defined()) continue;
    if (options_.kind == "sgd") {
      StepSgd(slot, learning_rate);
    } else {
      StepAdamW(slot, learning_rate);
    }
  }
}

void Optimiser::StepAdamW(Slot& slot, double learning_rate) const {
  const double t = double(num_steps_.item<int64_t>());
  const double mean_correction = 1 - std::pow(options_.beta1, t);
  const double square_correction = 1 - std::pow(options_.beta2, t);
  const double decay = slot.parameter.dim() > 1 ? 1 - learning_rate * options_.weight_decay : 1;
  const torch::Tensor parameters = slot.parameter.detach().view({-1}),
                      gradients = slot.parameter.grad().contiguous().view({-1}), means = slot.mean.view({-1}),
                      squares = slot.square.view({-1});
  ForEachPart(parameters.numel(), parameters.device(), [&](int64_t begin, int64_t end) {
    const auto part = [&](const torch::Tensor& numbers) { return numbers.slice(0, begin, end); };
    torch::Tensor parameter = part(parameters), mean = part(means), square = part(squares);
    const torch::Tensor gradient = part(gradients);
    mean.mul_(options_.beta1).add_(gradient, 1 - options_.beta1);
    square.mul_(options_.beta2).addcmul_(gradient, gradient, 1 - options_.beta2);
    if (decay != 1) parameter.mul_(decay);
    const torch::Tensor denominator = square.sqrt().div_(std::sqrt(square_correction)).add_(1e-8);
    parameter.addcdiv_(mean, denominator, -learning_rate / mean_correction);
  });
}

void Optimiser::StepSgd(Slot& slot, double learning_rate) const {
  slot.mean.mul_(options_.beta1).add_(slot.parameter.grad(), learning_rate);
  if (slot.parameter.dim() > 1) slot.mean.add_(slot.parameter, learning_rate * options_.weight_decay);
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
