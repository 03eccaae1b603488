#include "losses/edge_length_loss.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::losses {
namespace {

torch::Tensor EdgeLengths(const torch::Tensor& vertices, const torch::Tensor& edges) {
  constexpr double kLeastSquare = 1e-12;  // The square root has no derivative at 0.
  const torch::Tensor from = vertices.index_select(1, edges.select(1, 0)),
                      to = vertices.index_select(1, edges.select(1, 1));
  return (from - to).square().sum(2).clamp_min(kLeastSquare).sqrt();
}

}  // namespace

torch::Tensor EdgeLengthLoss(const torch::Tensor& predicted, const torch::Tensor& target, const torch::Tensor& edges,
                             const torch::Tensor& known) {
  tensor::CheckShape(predicted, {tensor::kAny, tensor::kAny, 3}, "predicted");
  tensor::CheckShape(target, predicted.sizes(), "target");
  tensor::CheckShape(edges, {tensor::kAny, 2}, "edges");
  tensor::CheckShape(known, {predicted.size(0)}, "known");
  const torch::Tensor squares = (EdgeLengths(predicted, edges) - EdgeLengths(target, edges)).square().mean(1);
  return (squares * known).sum() / known.sum().clamp_min(1);
}

torch::Tensor EdgesOf(const torch::Tensor& triangles) {
  tensor::CheckShape(triangles, {tensor::kAny, 3}, "triangles");
  const auto pairs = [&](int64_t a, int64_t b) {
    return at::stack({triangles.select(1, a), triangles.select(1, b)}, 1);
  };
  const torch::Tensor all = at::cat({pairs(0, 1), pairs(1, 2), pairs(2, 0)});
  return std::get<0>(at::unique_dim(std::get<0>(all.sort(1)), 0));
}

}  // namespace daumier::losses
