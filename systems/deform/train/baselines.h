#pragma once
#include "models/principal_components.h"

#include <torch/types.h>

#include <optional>

/// Predictors of a whole surface that need no training by steps: what a deformable model has to beat. Like the model,
/// those that look at the face are given all of its vertices.
namespace daumier::deform {

class DeformBaselines {
 public:
  /// training: (T, V, 3) float32, given away; validation: (n, V, 3), on which the ridge weight is chosen. As many
  /// components as are asked for, but at most T - 1. @throws Error if there are less than two training faces or no
  /// validation face, or if shapes disagree.
  DeformBaselines(torch::Tensor training, const torch::Tensor& validation, int num_components);

  /// (V, 3): the mean of the training faces.
  torch::Tensor Mean() const;
  /// Faces (B, V, 3) by their nearest training faces, by the sum of squared distances of vertices.
  torch::Tensor Nearest(const torch::Tensor& faces) const;
  /// Faces (B, V, 3) by the linear model: mean + sum_k c_k v_k / (v_k + ridge * mean v) d_k, c the scores on directions
  /// d of variances v, which is ridge regression with a prior of unit variance for each standardised score.
  torch::Tensor Linear(const torch::Tensor& faces) const { return Linear(faces, ridge_); }

  /// Of 0, 1e-6, 1e-5, ... 1e-1 the one with the least mean vertex error on the validation faces.
  double ridge() const { return ridge_; }
  const models::PrincipalComponents& components() const { return components_; }
  /// How many of the components explain this share of the training faces' variance; nothing if all do not.
  std::optional<int> ComponentsFor(double share) const;

 private:
  torch::Tensor Centred(const torch::Tensor& faces) const;
  torch::Tensor Linear(const torch::Tensor& faces, double ridge) const;

  torch::Tensor training_;  ///< (T, 3V), centred.
  models::PrincipalComponents components_;
  double ridge_ = 0;
};

}  // namespace daumier::deform
