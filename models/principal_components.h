#pragma once
#include <torch/types.h>

#include <cstdint>

namespace daumier::models {

/// The directions in which some vectors differ most.
struct PrincipalComponents {
  torch::Tensor mean;        ///< (D)
  torch::Tensor rows;        ///< (K, D), orthonormal, the strongest first.
  torch::Tensor deviations;  ///< (K): standard deviation of the vectors along each row.
};

/// The first `size` principal components of vectors (n, D) float32, by block power iteration [Halko et al. 2011,
/// algorithm 4.4]. Deterministic in seed. @throws Error if there are no more vectors than components.
PrincipalComponents FitPrincipalComponents(const torch::Tensor& vectors, int64_t size, uint64_t seed);

}  // namespace daumier::models
