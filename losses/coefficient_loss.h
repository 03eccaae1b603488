#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Supervision by known coefficients: sum_b k_b sum_j w_j (x_bj - y_bj)^2 / max(sum_b k_b, 1). predicted x, target y:
/// (B, J); weights w: (J), >= 0; known k: (B), 0 or 1, whether the coefficients of a picture are known.
/// @throws daumier::Error if a shape disagrees.
torch::Tensor CoefficientLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights,
                              const torch::Tensor& known);

/// Supervision by known vertices: sum_b k_b sum_v w_v |x_bv - y_bv|^2 / (max(sum_b k_b, 1) sum_v w_v), cm^2.
/// predicted x, target y: (B, V, 3) in cm; weights w: (V), >= 0; known k: (B).
/// @throws daumier::Error if a shape disagrees.
torch::Tensor KnownVertexLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights,
                              const torch::Tensor& known);

}  // namespace daumier::losses
