#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Weighted landmark error [Pan et al. 2024, eq. 4]: mean over the batch of 1/N sum_n w_n |q_n - p_n|^2, pixels^2.
/// predicted, target: (B, N, 2) in pixels; weights: (N), or (B, N) where they differ by picture.
/// @throws daumier::Error if a shape disagrees.
torch::Tensor LandmarkLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights);

/// Weights of the 68 landmarks (68), float32: 20 for the bridge of the nose (28 .. 30) and the inner lips (60 .. 67), 1
/// for the others [Deng et al. 2019].
torch::Tensor PortraitLandmarkWeights();

}  // namespace daumier::losses
