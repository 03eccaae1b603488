#pragma once
#include "eval/face_rows.h"

#include <vector>

namespace daumier::benchmark {

/// Linear regression of faces (or landmarks) on features of few samples of many numbers, by its dual [Saunders et al. 1998]:
///   y = mean_y + k(x)^T (K + lambda I)^-1 (Y - mean_y),  k_i(x) = (x - mean_x) . (x_i - mean_x) / scale,
/// scale such that K has a mean diagonal of 1.
class DualRegression {
 public:
  /// features: n x d, targets: n x m. @throws Error if the numbers of rows differ or there is none.
  DualRegression(const eval::FaceRows& features, const eval::FaceRows& targets);

  /// The targets of features (q x d), with lambda > 0.
  eval::FaceRows Predict(const eval::FaceRows& features, double lambda) const;

 private:
  eval::FaceRows features_, targets_;  ///< Centred.
  Eigen::RowVectorXf feature_mean_, target_mean_;
  double scale_ = 1;
  Eigen::MatrixXd kernel_;
};

/// 1e-4, 1e-3, ... 1e2: relative to the kernel's mean diagonal.
std::vector<double> RegressionLambdas();

}  // namespace daumier::benchmark
