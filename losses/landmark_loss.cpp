#include "losses/landmark_loss.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {

torch::Tensor LandmarkLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights) {
  tensor::CheckShape(predicted, {tensor::kAny, tensor::kAny, 2}, "predicted");
  tensor::CheckShape(target, predicted.sizes(), "target");
  const int64_t batch = predicted.size(0), count = predicted.size(1);
  if (weights.dim() == 1) {
    tensor::CheckShape(weights, {count}, "weights");
  } else {
    tensor::CheckShape(weights, {batch, count}, "weights");
  }
  return ((predicted - target).square().sum(2) * weights).sum() / double(batch * count);
}

torch::Tensor PortraitLandmarkWeights() {
  constexpr double kMarked = 20;
  torch::Tensor weights = at::ones({68});
  weights.slice(0, 28, 31).fill_(kMarked);
  weights.slice(0, 60, 68).fill_(kMarked);
  return weights;
}

}  // namespace daumier::losses
