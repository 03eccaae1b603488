#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// What cells of a search map have to be, as arrays of B pictures.
struct BoxTargets {
  torch::Tensor score;   ///< (B, H, W): 1 in the cell of a box's centre, falling off around it, 0 elsewhere.
  torch::Tensor box;     ///< (B, 4, H, W): offset of the centre from the cell's centre, logarithms of width and height.
  torch::Tensor weight;  ///< (B, H, W): of the box in a cell; 0 where there is none.
};

/// The two parts of the loss of a search map.
struct BoxLossTerms {
  torch::Tensor score, box;
};

/// score: focal loss of centres [Zhou et al. 2019, eq. 1], p = sigmoid of channel 0, t the target,
///   - sum (t = 1: (1 - p)^2 log p; otherwise: (1 - t)^4 p^2 log(1 - p)) / max(1, number of cells with t = 1);
/// box: sum w |b - t| / max(1, sum w), summed over the four numbers of a box.
/// boxes: (B, 5, H, W) as HeatMapOutputs has them. @throws daumier::Error if a shape disagrees.
BoxLossTerms BoxLoss(const torch::Tensor& boxes, const BoxTargets& targets);

}  // namespace daumier::losses
