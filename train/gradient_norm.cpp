#include "train/gradient_norm.h"

#include "core/error.h"
#include "tensor/torch_version.h"

#include <ATen/Functions.h>
#include <ATen/Parallel.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

#if defined(__x86_64__)
#define DAUMIER_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DAUMIER_FOR_EACH_PROCESSOR
#endif

namespace daumier::train {
namespace {

constexpr int64_t kPart = 16384;
constexpr int64_t kLanes = 8;
using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
using Doubles = double __attribute__((vector_size(kLanes * sizeof(double))));

/// Squares of floats are exact in double precision: fused and unfused products give the same sum.
DAUMIER_FOR_EACH_PROCESSOR double SumOfSquares(const float* numbers, int64_t count) {
  Doubles sums[2] = {};
  int64_t i = 0;
  for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
    for (int64_t k = 0; k < 2; ++k) {
      Floats part;
      std::memcpy(&part, numbers + i + k * kLanes, sizeof(part));
      const Doubles wide = __builtin_convertvector(part, Doubles);
      sums[k] += wide * wide;
    }
  }
  double sum = 0;
  for (int64_t lane = 0; lane < kLanes; ++lane) sum += sums[0][lane] + sums[1][lane];
  for (; i < count; ++i) sum += double(numbers[i]) * double(numbers[i]);
  return sum;
}

bool IsPlain(const torch::Tensor& tensor) {
  return tensor.is_cpu() && tensor.scalar_type() == torch::kFloat32 && tensor.is_non_overlapping_and_dense();
}

}  // namespace

torch::Tensor GradientNorm(const std::vector<torch::Tensor>& gradients) {
  const at::NoGradGuard no_grad;
  DAUMIER_CHECK(!gradients.empty(), "there is no gradient to measure");
  torch::Tensor sum = torch::zeros({}, gradients.front().options().dtype(torch::kFloat64));
  std::vector<std::span<const float>> parts;
  for (const torch::Tensor& gradient : gradients) {
    if (!IsPlain(gradient)) {
      sum += gradient.norm().to(torch::kFloat64).square();
      continue;
    }
    const int64_t count = gradient.numel();
    for (int64_t begin = 0; begin < count; begin += kPart)
      parts.emplace_back(gradient.data_ptr<float>() + begin, size_t(std::min(kPart, count - begin)));
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
