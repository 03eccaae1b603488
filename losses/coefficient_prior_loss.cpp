#include "losses/coefficient_prior_loss.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {

torch::Tensor CoefficientPriorLoss(const torch::Tensor& identity, const torch::Tensor& expression,
                                   const torch::Tensor& albedo, const CoefficientPriorWeights& weights) {
  tensor::CheckShape(identity, {tensor::kAny, tensor::kAny}, "identity");
  tensor::CheckShape(expression, {identity.size(0), tensor::kAny}, "expression");
  tensor::CheckShape(albedo, {identity.size(0), tensor::kAny}, "albedo");
  const torch::Tensor sum = weights.identity * identity.square().sum() +
                            weights.expression * expression.square().sum() + weights.albedo * albedo.square().sum();
  return sum / double(identity.size(0));
}

}  // namespace daumier::losses
