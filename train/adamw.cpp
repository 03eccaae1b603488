#include "train/adamw.h"

#include "tensor/shape.h"
#include "tensor/torch_version.h"
#include "train/adamw_kernel.h"

#include <ATen/Functions.h>
#include <ATen/Parallel.h>

#include <algorithm>

namespace daumier::train {
namespace {

/// What a processor's nearest cache holds four times.
constexpr int64_t kPartSize = 8192;

/// A part of one parameter, for one thread.
struct Part {
  const AdamWFactors* factors;
  AdamWNumbers numbers;
  int64_t begin, end;
};

bool HasKernel(const AdamWUpdate& update) {
  const auto strides = update.parameter.strides();
  return HasAdamWKernel() && tensor::IsDenseFloat(update.parameter) && tensor::IsDenseFloat(update.mean) &&
         tensor::IsDenseFloat(update.square) && update.mean.strides() == strides && update.square.strides() == strides;
}

}  // namespace

void UpdateAdamWByTensors(const AdamWUpdate& update) {
  const at::NoGradGuard no_grad;
  const AdamWFactors& factors = update.factors;
  const torch::Tensor& gradient = update.gradient;
  update.mean.mul_(factors.beta1).add_(gradient, 1 - factors.beta1);
  update.square.mul_(factors.beta2).addcmul_(gradient, gradient, 1 - factors.beta2);
  if (factors.decay != 1) update.parameter.mul_(factors.decay);
  const torch::Tensor denominator = update.square.sqrt().div_(factors.root_correction).add_(1e-8);
  update.parameter.addcdiv_(update.mean, denominator, -factors.step_size);
}

void UpdateAdamW(const std::vector<AdamWUpdate>& updates) {
  const at::NoGradGuard no_grad;
  std::vector<torch::Tensor> gradients;  // Keeps copies alive.
  std::vector<Part> parts;
  for (const AdamWUpdate& update : updates) {
    if (!HasKernel(update)) {
      UpdateAdamWByTensors(update);
      continue;
    }
    const bool is_alike =
        tensor::IsDenseFloat(update.gradient) && update.gradient.strides() == update.parameter.strides();
    gradients.push_back(is_alike ? update.gradient : torch::empty_like(update.parameter).copy_(update.gradient));
    const AdamWNumbers numbers{gradients.back().data_ptr<float>(), update.mean.data_ptr<float>(),
                               update.square.data_ptr<float>(), update.parameter.data_ptr<float>()};
    const int64_t count = update.parameter.numel();
    for (int64_t begin = 0; begin < count; begin += kPartSize)
      parts.push_back({&update.factors, numbers, begin, std::min(count, begin + kPartSize)});
  }
  at::parallel_for(0, int64_t(parts.size()), 1, [&](int64_t first, int64_t last) {
    for (int64_t i = first; i < last; ++i) {
      const Part& part = parts[size_t(i)];
      AdamWKernel(*part.factors, part.numbers, part.begin, part.end);
    }
  });
}

}  // namespace daumier::train
