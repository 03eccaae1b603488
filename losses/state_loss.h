#pragma once
#include <torch/types.h>

#include <vector>

namespace daumier::losses {

/// Cross-entropy of states of a picture, in nats: the mean, over all states that are known, of -log softmax(s)[c].
/// scores: (B, S), the classes of all states in a row; num_classes: of each of G states, S together; classes: (B, G)
/// int64, kNoLabel (losses/label_loss.h) where a state is unknown; state_weights: (G). The mean is weighted by them, and 0
/// if nothing is known. @throws daumier::Error if a shape disagrees.
torch::Tensor StateLoss(const torch::Tensor& scores, const std::vector<int>& num_classes, const torch::Tensor& classes,
                        const torch::Tensor& state_weights);

}  // namespace daumier::losses
