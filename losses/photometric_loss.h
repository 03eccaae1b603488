#pragma once
#include <torch/types.h>

namespace daumier::losses {

enum class ColourDistance {
  kSquared,  ///< |d|^2 over RGB, as [Pan et al. 2024, eq. 5] prints it.
  kLength,   ///< sqrt(|d|^2 + 1e-6), as [Deng et al. 2019] compute it and the paper's weight suggests.
};

/// Colour difference of a rendered face [Pan et al. 2024, eq. 5]: sum_p m_p D(I'_p - I_p) / max(sum_p m_p, 1), over all
/// pixels of the batch. rendered, picture: (B, 3, H, W), colours 0 .. 1; mask m: (B, 1, H, W), 0 .. 1, the pixels that
/// show the face in both; no gradient reaches it. @throws daumier::Error if a shape disagrees.
torch::Tensor PhotometricLoss(const torch::Tensor& rendered, const torch::Tensor& picture, const torch::Tensor& mask,
                              ColourDistance distance = ColourDistance::kLength);

}  // namespace daumier::losses
