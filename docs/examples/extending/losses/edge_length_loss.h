#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Difference of edge lengths: sum_b k_b 1/E sum_e (|x_bi - x_bj| - |y_bi - y_bj|)^2 / max(sum_b k_b, 1), cm^2, over the
/// edges e = (i, j). predicted x, target y: (B, V, 3) in cm; edges: (E, 2) int64; known k: (B), 0 or 1.
/// Rotations and translations of a face change nothing. @throws daumier::Error if a shape disagrees.
torch::Tensor EdgeLengthLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& edges,
                             const torch::Tensor& known);

/// Each edge of triangles (T, 3) int64 once: (E, 2), the lower vertex first.
torch::Tensor EdgesOf(const torch::Tensor& triangles);

}  // namespace daumier::losses
