#pragma once
#include "systems/portrait/train/portrait_loss.h"

namespace daumier::portrait {

struct RefinementOptions {
  int steps = 25;
  /// Steps of Adam [Kingma and Ba 2015] in units of what is usual for a coefficient: falls linearly to a tenth.
  double rate = 0.06;
};

/// Coefficients (1, 239) of one portrait, refined by gradients through the renderer from a first guess: Adam on `loss` of
/// the batch (one sample of CropSamples), expression weights of kUnit cut off to 0 .. 1 after each step. The best
/// coefficients seen are returned, so that the loss never grows.
torch::Tensor RefinePortrait(const PortraitLoss& loss, const torch::Tensor& guess, const train::Batch& batch,
                             faces::ExpressionWeights weights, const RefinementOptions& options = {});

}  // namespace daumier::portrait
