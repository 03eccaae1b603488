#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// The distribution of a point over the cells of a map: a Gaussian of `deviation` cells sampled at the cells' centres
/// and normalised to 1. points: (B, L, 2), x and y in cells, the centre of cell (0, 0) at (0.5, 0.5); of any value.
/// Returns (B, L, height, width).
torch::Tensor PointDistributions(const torch::Tensor& points, int64_t height, int64_t width, double deviation);

/// Divergence of heat maps from the distributions of their points, in nats:
///   E = sum_l w_l KL(t_l || softmax(h_l)) / max(1, sum_l w_l),
/// the softmax over all cells of a map, t_l = PointDistributions. heat_maps: (B, L, H, W) scores, points: (B, L, 2) in
/// cells, weights: (B, L), 0 for points that are unknown or outside of the map. Zero iff the softmax is the point's
/// distribution wherever w_l > 0. @throws daumier::Error if a shape disagrees or deviation is not positive.
torch::Tensor HeatMapLoss(const torch::Tensor& heat_maps, const torch::Tensor& points, const torch::Tensor& weights,
                          double deviation);

}  // namespace daumier::losses
