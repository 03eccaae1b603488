#include "losses/vertex_loss.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/Functions.h>
#include <ATen/ops/linalg_qr.h>

namespace daumier::losses {
namespace {

/// (3V): each weight three times, for x, y and z.
torch::Tensor CoordinateWeights(const torch::Tensor& core, const torch::Tensor& weights) {
  tensor::CheckShape(core, {tensor::kAny, tensor::kAny}, "core");
  DAUMIER_CHECK(core.size(1) % 3 == 0, "core has {} columns, expected 3 a vertex", core.size(1));
  tensor::CheckShape(weights, {core.size(1) / 3}, "weights");
  return weights.repeat_interleave(3);
}

}  // namespace

torch::Tensor VertexLoss(const torch::Tensor& core, const torch::Tensor& q, const torch::Tensor& target,
                         const torch::Tensor& weights) {
  const auto coordinate_weights = CoordinateWeights(core, weights);
  tensor::CheckShape(q, {tensor::kAny, core.size(0)}, "q");
  tensor::CheckShape(target, {q.size(0), core.size(1)}, "target");
  const auto difference = at::mm(q, core) - target;
  return (difference.square() * coordinate_weights).sum() / static_cast<double>(weights.size(0) * q.size(0));
}

GramVertexLoss::GramVertexLoss(const torch::Tensor& core, const torch::Tensor& weights) {
  at::NoGradGuard no_grad;
  root_weights_ = CoordinateWeights(core, weights).sqrt();
  std::tie(basis_, root_gram_) = at::linalg_qr((core * root_weights_).t(), "reduced");
}

SufficientStatistics GramVertexLoss::Moments(const torch::Tensor& target) const {
  tensor::CheckShape(target, {tensor::kAny, root_weights_.size(0)}, "target");
  at::NoGradGuard no_grad;
  const auto weighted = target * root_weights_;
  const auto linear = at::mm(weighted, basis_);
  const auto unreachable = weighted - at::mm(linear, basis_.t());
  return {linear, unreachable.square().sum(1)};
}

torch::Tensor GramVertexLoss::operator()(const torch::Tensor& q, const SufficientStatistics& moments) const {
  tensor::CheckShape(q, {tensor::kAny, root_gram_.size(1)}, "q");
  tensor::CheckShape(moments.linear, {q.size(0), root_gram_.size(0)}, "moments.linear");
  tensor::CheckShape(moments.constant, {q.size(0)}, "moments.constant");
  const auto difference = at::mm(q, root_gram_.t()) - moments.linear;
  const double num_vertices = static_cast<double>(root_weights_.size(0)) / 3.0;
  return (difference.square().sum() + moments.constant.sum()) / (num_vertices * static_cast<double>(q.size(0)));
}

}  // namespace daumier::losses
