#pragma once
#include "eval/linear_model.h"
#include "eval/nearest_neighbour.h"

#include <torch/types.h>

#include <optional>

/// Predictors of a whole surface that need no training by steps: what a deformable model has to beat. Like the model,
/// those that look at the face are given all of its vertices.
namespace daumier::deform {

/// The baselines of eval/ on tensors of faces.
class DeformBaselines {
 public:
  /// training: (T, V, 3) float32, moved from; validation: (n, V, 3), on which the ridge weight is chosen. The requested
  /// number of components, but at most T - 1. @throws Error if there are less than two training faces or no validation
  /// face, or if shapes disagree.
  DeformBaselines(torch::Tensor training, const torch::Tensor& validation, int num_components);

  /// (V, 3): the mean of the training faces.
  torch::Tensor Mean() const;
  /// Faces (B, V, 3) by their nearest training faces, by the sum of squared distances of vertices.
  torch::Tensor Nearest(const torch::Tensor& faces) const;
  /// Faces (B, V, 3) by the linear model.
  torch::Tensor Linear(const torch::Tensor& faces) const;

  const eval::LinearModel& linear_model() const { return linear_model_; }
  double ridge() const { return linear_model_.ridge; }
  /// How many of the components explain this share of the training faces' variance; nothing if all do not.
  std::optional<int> ComponentsFor(double share) const { return linear_model_.ComponentsFor(share); }

 private:
  DeformBaselines(eval::CentredRows training, const eval::FaceRows& validation, int num_components);

  eval::LinearModel linear_model_;
  eval::NearestNeighbour nearest_;  ///< Of the training faces without their mean.
};

}  // namespace daumier::deform
