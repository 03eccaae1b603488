#include "losses/heat_map_loss.h"

#include "core/error.h"
#include "tensor/shape.h"

#include <ATen/ops/arange.h>
#include <ATen/ops/log_softmax.h>
#include <ATen/ops/softmax.h>

namespace daumier::losses {
namespace {

/// Logarithms of an unnormalised Gaussian at the centres of `size` cells, (B, L, size).
torch::Tensor AlongAxis(const torch::Tensor& positions, int64_t size, double deviation) {
  const torch::Tensor centres = at::arange(size, positions.options()) + 0.5;
  return (centres - positions.unsqueeze(-1)).square() * (-0.5 / (deviation * deviation));
}

}  // namespace

torch::Tensor PointDistributions(const torch::Tensor& points, int64_t height, int64_t width, double deviation) {
  tensor::CheckShape(points, {tensor::kAny, tensor::kAny, 2}, "points");
  DAUMIER_CHECK(deviation > 0, "the deviation of a heat map is {}, expected a positive number", deviation);
  const torch::Tensor x = at::softmax(AlongAxis(points.select(2, 0), width, deviation), -1);
  const torch::Tensor y = at::softmax(AlongAxis(points.select(2, 1), height, deviation), -1);
  return y.unsqueeze(3) * x.unsqueeze(2);
}

torch::Tensor HeatMapLoss(const torch::Tensor& heat_maps, const torch::Tensor& points, const torch::Tensor& weights,
                          double deviation) {
  tensor::CheckShape(heat_maps, {tensor::kAny, tensor::kAny, tensor::kAny, tensor::kAny}, "heat_maps");
  const int64_t batch = heat_maps.size(0), count = heat_maps.size(1);
  tensor::CheckShape(points, {batch, count, 2}, "points");
  tensor::CheckShape(weights, {batch, count}, "weights");
  const torch::Tensor target = PointDistributions(points, heat_maps.size(2), heat_maps.size(3), deviation).flatten(2);
  const torch::Tensor divergence =
      (at::xlogy(target, target) - target * at::log_softmax(heat_maps.flatten(2), 2)).sum(2);
  return (divergence * weights).sum() / weights.sum().clamp_min(1);
}

}  // namespace daumier::losses
