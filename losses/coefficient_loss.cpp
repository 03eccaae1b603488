#include "losses/coefficient_loss.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {

torch::Tensor CoefficientLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights,
                              const torch::Tensor& known) {
  tensor::CheckShape(predicted, {tensor::kAny, tensor::kAny}, "predicted");
  tensor::CheckShape(target, predicted.sizes(), "target");
  tensor::CheckShape(weights, {predicted.size(1)}, "weights");
  tensor::CheckShape(known, {predicted.size(0)}, "known");
  const torch::Tensor squares = ((predicted - target).square() * weights).sum(1);
  return (squares * known).sum() / known.sum().clamp_min(1);
}

torch::Tensor KnownVertexLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& weights,
                              const torch::Tensor& known) {
  tensor::CheckShape(predicted, {tensor::kAny, tensor::kAny, 3}, "predicted");
  tensor::CheckShape(target, predicted.sizes(), "target");
  tensor::CheckShape(weights, {predicted.size(1)}, "weights");
  tensor::CheckShape(known, {predicted.size(0)}, "known");
  const torch::Tensor squares = at::matmul((predicted - target).square().sum(2), weights) / weights.sum();
  return (squares * known).sum() / known.sum().clamp_min(1);
}

}  // namespace daumier::losses
