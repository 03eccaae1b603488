#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Variance of the skin's albedo [Deng et al. 2019]: mean over the batch of sum_v w_v |t_v - m|^2 / sum_v w_v with m =
/// sum_v w_v t_v / sum_v w_v. It keeps shading out of the albedo. albedo t: (B, V, 3); weights w: (V), >= 0, of skin.
/// Zero iff the skin has one colour. @throws daumier::Error if a shape disagrees.
torch::Tensor ReflectanceLoss(const torch::Tensor& albedo, const torch::Tensor& weights);

}  // namespace daumier::losses
