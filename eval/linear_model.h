#pragma once
#include "eval/principal_components.h"

#include <optional>

namespace daumier::eval {

/// Faces by principal components: mean + sum_k c_k v_k / (v_k + ridge * mean v) d_k, c the scores of a face on
/// directions d of variances v. It is ridge regression with a prior of unit variance for each standardised score.
/// A direction without variance is not used.
struct LinearModel {
  PrincipalComponents components;
  double ridge = 0;
  double total_variance = 0;  ///< Mean squared distance of the training faces from their mean.

  /// Faces n x 3V by their own vertices. @throws Error if the number of coordinates differs.
  FaceRows Predict(const FaceRows& faces) const;
  /// How many of the components explain this share of the training faces' variance; nothing if all do not.
  std::optional<int> ComponentsFor(double share) const;
};

/// min(num_components, T - 1) components of T training faces. Of 0, 1e-6, 1e-5, ... 1e-1 the ridge weight is the one
/// with the least mean vertex distance on the validation faces. @throws Error if there are fewer than two training
/// faces or no validation face, or if a coordinate is not finite.
LinearModel FitLinearModel(const CentredRows& training, const FaceRows& validation, int num_components, uint64_t seed);

}  // namespace daumier::eval
