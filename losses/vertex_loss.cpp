#include "losses/vertex_loss.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <ATen/Functions.h>
#include <ATen/ops/linalg_qr.h>

namespace daumier::losses {
namespace {

/// (B, Ku * Kv): the products u_k v_l, l running fastest.
torch::Tensor OuterProducts(const torch::Tensor& u, const torch::Tensor& v, int64_t num_products) {
  tensor::CheckShape(u, {tensor::kAny, tensor::kAny}, "u");
  tensor::CheckShape(v, {u.size(0), tensor::kAny}, "v");
  DAUMIER_CHECK(u.size(1) * v.size(1) == num_products, "u x v has {} x {} products, but the core has {}", u.size(1),
                v.size(1), num_products);
  return (u.unsqueeze(2) * v.unsqueeze(1)).flatten(1);
}

/// (3V): each weight three times, for x, y and z.
torch::Tensor CoordinateWeights(const torch::Tensor& core, const torch::Tensor& weights) {
  tensor::CheckShape(core, {tensor::kAny, tensor::kAny}, "core");
  DAUMIER_CHECK(core.size(1) % 3 == 0, "core has {} columns, expected 3 a vertex", core.size(1));
  tensor::CheckShape(weights, {core.size(1) / 3}, "weights");
  return weights.repeat_interleave(3);
}

}  // namespace

torch::Tensor VertexLoss(const torch::Tensor& core, const torch::Tensor& u, const torch::Tensor& v,
                         const torch::Tensor& target, const torch::Tensor& weights) {
  const auto coordinate_weights = CoordinateWeights(core, weights);
  const auto products = OuterProducts(u, v, core.size(0));
  tensor::CheckShape(target, {u.size(0), core.size(1)}, "target");
  const auto difference = at::mm(products, core) - target;
  return (difference.square() * coordinate_weights).sum() / static_cast<double>(weights.size(0) * u.size(0));
}

GramVertexLoss::GramVertexLoss(const torch::Tensor& core, const torch::Tensor& weights) {
  at::NoGradGuard no_grad;
  root_weights_ = CoordinateWeights(core, weights).sqrt();
  std::tie(basis_, root_gram_) = at::linalg_qr((core * root_weights_).t(), "reduced");
}

VertexMoments GramVertexLoss::Moments(const torch::Tensor& target) const {
  tensor::CheckShape(target, {tensor::kAny, root_weights_.size(0)}, "target");
  at::NoGradGuard no_grad;
  const auto weighted = target * root_weights_;
  const auto linear = at::mm(weighted, basis_);
  const auto unreachable = weighted - at::mm(linear, basis_.t());
  return {linear, unreachable.square().sum(1)};
}

torch::Tensor GramVertexLoss::operator()(const torch::Tensor& u, const torch::Tensor& v,
                                         const VertexMoments& moments) const {
  const auto products = OuterProducts(u, v, root_gram_.size(1));
  tensor::CheckShape(moments.linear, {u.size(0), root_gram_.size(0)}, "moments.linear");
  tensor::CheckShape(moments.constant, {u.size(0)}, "moments.constant");
  const auto difference = at::mm(products, root_gram_.t()) - moments.linear;
  const double num_vertices = static_cast<double>(root_weights_.size(0)) / 3.0;
  return (difference.square().sum() + moments.constant.sum()) / (num_vertices * static_cast<double>(u.size(0)));
}

}  // namespace daumier::losses
