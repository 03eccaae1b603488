#include "models/principal_components.h"

#include "core/error.h"
#include "core/random.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/CPUGeneratorImpl.h>
#include <torch/linalg.h>
#include <torch/utils.h>

#include <algorithm>

namespace daumier::models {
namespace {

/// Directions beyond those asked for, and passes over the vectors: both sharpen the last components.
constexpr int64_t kSpare = 16;
constexpr int kPasses = 6;

torch::Tensor Orthonormal(const torch::Tensor& columns) {
  return std::get<0>(torch::linalg_qr(columns));
}

}  // namespace

PrincipalComponents FitPrincipalComponents(const torch::Tensor& vectors, int64_t size, uint64_t seed) {
  tensor::CheckShape(vectors, {tensor::kAny, tensor::kAny}, "vectors");
  const int64_t num_vectors = vectors.size(0), length = vectors.size(1);
  DAUMIER_CHECK(num_vectors > size && length >= size, "{} principal components of {} vectors of {} numbers", size,
                num_vectors, length);
  const at::NoGradGuard no_grad;
  const torch::Tensor mean = vectors.mean(0), centred = vectors - mean;
  const int64_t num_directions = std::min({size + kSpare, num_vectors, length});
  const at::Generator generator = at::detail::createCPUGenerator(Stream(seed, "principal components").Bits());
  torch::Tensor directions = Orthonormal(
      torch::matmul(centred.t(), torch::randn({num_vectors, num_directions}, generator, vectors.options())));
  for (int pass = 0; pass < kPasses; ++pass)
    directions = Orthonormal(torch::matmul(centred.t(), torch::matmul(centred, directions)));
  const torch::Tensor inside = torch::matmul(centred, directions).to(torch::kFloat64);
  const auto [variances, axes] = torch::linalg_eigh(torch::matmul(inside.t(), inside) / double(num_vectors));
  const auto strongest = [&](const torch::Tensor& numbers, int64_t dimension) {
    return numbers.flip({dimension}).narrow(dimension, 0, size);
  };
  return {mean, torch::matmul(strongest(axes, 1).t().to(torch::kFloat32), directions.t()).contiguous(),
          strongest(variances, 0).clamp_min(0).sqrt().to(torch::kFloat32)};
}

}  // namespace daumier::models
