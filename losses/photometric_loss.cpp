#include "losses/photometric_loss.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {

torch::Tensor PhotometricLoss(const torch::Tensor& rendered, const torch::Tensor& picture, const torch::Tensor& mask,
                              ColourDistance distance) {
  constexpr double kRounding = 1e-6;
  tensor::CheckShape(rendered, {tensor::kAny, 3, tensor::kAny, tensor::kAny}, "rendered");
  tensor::CheckShape(picture, rendered.sizes(), "picture");
  tensor::CheckShape(mask, {rendered.size(0), 1, rendered.size(2), rendered.size(3)}, "mask");
  torch::Tensor difference = (rendered - picture).square().sum(1, /*keepdim=*/true);
  if (distance == ColourDistance::kLength) difference = (difference + kRounding).sqrt();
  const torch::Tensor constant = mask.detach();
  return (difference * constant).sum() / constant.sum().clamp_min(1);
}

}  // namespace daumier::losses
