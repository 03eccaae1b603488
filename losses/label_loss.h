#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// The label of a pixel that does not count.
inline constexpr int64_t kNoLabel = -100;

/// Class-weighted cross-entropy of pixels, in nats:
///   E = - sum_p w_{c_p} log softmax(s_p)[c_p] / max(1, sum_p w_{c_p}),
/// both sums over the pixels that have a label. scores: (B, C, H, W), labels: (B, H, W) int64 of 0..C-1 or kNoLabel,
/// class_weights: (C). @throws daumier::Error if a shape disagrees.
torch::Tensor LabelLoss(const torch::Tensor& scores, const torch::Tensor& labels, const torch::Tensor& class_weights);

}  // namespace daumier::losses
