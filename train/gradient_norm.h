#pragma once
#include <torch/types.h>

#include <vector>

namespace daumier::train {

/// The length of all these tensors together, sqrt(sum g^2), a float64 scalar on their device; NaN or infinite if a
/// number is. float32 tensors on a CPU are summed in float64 by all threads of LibTorch, with the same bytes for any
/// number of threads. @throws Error if there is no tensor.
torch::Tensor GradientNorm(const std::vector<torch::Tensor>& gradients);

}  // namespace daumier::train
