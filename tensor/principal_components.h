#pragma once
#include <torch/types.h>

namespace daumier::tensor {

/// Directions in which rows vary most: a row is about mean + scores * directions.
struct PrincipalComponents {
  torch::Tensor mean;         ///< (D)
  torch::Tensor directions;   ///< (K, D), orthonormal rows, by falling deviation.
  torch::Tensor deviations;   ///< (K), root mean square of the scores.
  double total_variance = 0;  ///< Mean squared distance of a row from the mean: the sum of all squared deviations.

  /// How many directions explain this share of the total variance; K + 1 if these do not.
  int NumFor(double share) const;
};

/// The `size` principal components of rows (n, D), float32, which this centres in place. By subspace iteration with 16
/// directions more than asked for [Halko et al. 2011, algorithm 4.4], all large products in LibTorch; needs memory for
/// one (size + 16, D) beside the rows. Deterministic.
/// @throws Error if there are fewer rows, or fewer independent ones, than directions.
PrincipalComponents FitPrincipalComponents(torch::Tensor& rows, int size);

}  // namespace daumier::tensor
