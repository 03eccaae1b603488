#include "train/gradient_norm.h"

#include "core/error.h"
#include "core/kernels.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/Functions.h>
#include <ATen/Parallel.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

namespace daumier::train {
namespace {

constexpr int64_t kSumSize = 16384;
constexpr int64_t kSumLanes = 8;
using FloatLanes = float __attribute__((vector_size(kSumLanes * sizeof(float))));
using DoubleLanes = double __attribute__((vector_size(kSumLanes * sizeof(double))));

/// Squares of floats are exact in double precision: fused and unfused products give the same sum.
DAUMIER_FOR_EACH_PROCESSOR double SumOfSquares(const float* numbers, int64_t count) {
  DoubleLanes sums[2] = {};
  int64_t i = 0;
  for (; i + 2 * kSumLanes <= count; i += 2 * kSumLanes) {
    for (int64_t k = 0; k < 2; ++k) {
      FloatLanes part;
      std::memcpy(&part, numbers + i + k * kSumLanes, sizeof(part));
      const DoubleLanes wide = __builtin_convertvector(part, DoubleLanes);
      sums[k] += wide * wide;
    }
  }
  double sum = 0;
  for (int64_t lane = 0; lane < kSumLanes; ++lane) sum += sums[0][lane] + sums[1][lane];
  for (; i < count; ++i) sum += double(numbers[i]) * double(numbers[i]);
  return sum;
}

}  // namespace

torch::Tensor GradientNorm(const std::vector<torch::Tensor>& gradients) {
  const at::NoGradGuard no_grad;
  DAUMIER_CHECK(!gradients.empty(), "there is no gradient to measure");
  torch::Tensor sum = torch::zeros({}, gradients.front().options().dtype(torch::kFloat64));
  std::vector<std::span<const float>> parts;
  for (const torch::Tensor& gradient : gradients) {
    if (!tensor::IsDenseFloat(gradient)) {
      sum += gradient.norm().to(torch::kFloat64).square();
      continue;
    }
    const int64_t count = gradient.numel();
    for (int64_t begin = 0; begin < count; begin += kSumSize)
      parts.emplace_back(gradient.data_ptr<float>() + begin, size_t(std::min(kSumSize, count - begin)));
  }
  std::vector<double> sums(parts.size());
  at::parallel_for(0, int64_t(parts.size()), 4, [&](int64_t first, int64_t last) {
    for (int64_t i = first; i < last; ++i)
      sums[size_t(i)] = SumOfSquares(parts[size_t(i)].data(), int64_t(parts[size_t(i)].size()));
  });
  sum += std::accumulate(sums.begin(), sums.end(), 0.0);
  return sum.sqrt();
}

}  // namespace daumier::train
