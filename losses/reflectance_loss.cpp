#include "losses/reflectance_loss.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {

torch::Tensor ReflectanceLoss(const torch::Tensor& albedo, const torch::Tensor& weights) {
  tensor::CheckShape(albedo, {tensor::kAny, tensor::kAny, 3}, "albedo");
  tensor::CheckShape(weights, {albedo.size(1)}, "weights");
  const torch::Tensor shares = (weights / weights.sum()).view({1, -1, 1});
  const torch::Tensor mean = (albedo * shares).sum(1, /*keepdim=*/true);
  return ((albedo - mean).square() * shares).sum() / double(albedo.size(0));
}

}  // namespace daumier::losses
