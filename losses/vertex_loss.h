#pragma once
#include <torch/types.h>

namespace daumier::losses {

/// Weighted vertex error [Han et al. 2017, eq. 2]: E = 1/V sum_i w_i ||(q C)_i - g_i||^2, mean over the batch, in cm^2.
/// core: C (K, 3V), q: (B, K), target: (B, 3V) in cm, weights: (V). Of a bilinear face q = u (x) v, the products u_k
/// v_l. Zero iff the faces agree wherever w_i > 0. @throws daumier::Error if the shapes disagree.
torch::Tensor VertexLoss(const torch::Tensor& core, const torch::Tensor& q, const torch::Tensor& target,
                         const torch::Tensor& weights);

/// Sufficient statistics of a face for GramVertexLoss.
struct SufficientStatistics {
  torch::Tensor
      linear;  ///< (B, K), t: the face's coordinates in an orthonormal basis of all faces that the model can make.
  torch::Tensor constant;  ///< (B), r: the part of g' W g that no coefficients reach.
};

/// The same number without reading a vertex. With G = C W C', h = C W g,
///   E = 1/V (q' G q - 2 h' q + g' W g).
/// It is evaluated as a sum of squares, E = 1/V (||R q - t||^2 + r), from the thin QR decomposition W^(1/2) C' = Q R: G
/// = R' R, h = R' t, t = Q' W^(1/2) g. The expanded sum would cancel: in float32 it keeps no digit of an error of 1 mm
/// on a head 1 m from the origin, the squares keep five. Equal to VertexLoss within 1e-6 in float64, and
/// 20 to 50 times cheaper in training (bench/vertex_loss_bench.cpp). The gradient reaches q only: core and weights
/// are constants, as they are in the network.
class GramVertexLoss {
 public:
  /// core: (K, 3V), weights: (V), not negative. @throws daumier::Error if the shapes disagree.
  GramVertexLoss(const torch::Tensor& core, const torch::Tensor& weights);
  /// target: (B, 3V). Computed once a face, before training. @throws daumier::Error if the shape disagrees.
  SufficientStatistics Moments(const torch::Tensor& target) const;
  /// q: (B, K). @throws daumier::Error if the shapes disagree.
  torch::Tensor operator()(const torch::Tensor& q, const SufficientStatistics& moments) const;

 private:
  torch::Tensor root_weights_;  ///< (3V) W^(1/2)
  torch::Tensor basis_;         ///< (3V, min(K, 3V)) Q
  torch::Tensor root_gram_;     ///< (min(K, 3V), K) R
};

}  // namespace daumier::losses
