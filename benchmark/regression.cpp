#include "benchmark/regression.h"

#include "core/error.h"

#include <Eigen/Cholesky>

namespace daumier::benchmark {

DualRegression::DualRegression(const eval::FaceRows& features, const eval::FaceRows& targets) {
  DAUMIER_CHECK(features.rows() == targets.rows(), "{} rows of features, {} of targets", features.rows(),
                targets.rows());
  eval::CentredRows x = eval::Centre(features), y = eval::Centre(targets);
  features_ = std::move(x.rows);
  feature_mean_ = std::move(x.mean);
  targets_ = std::move(y.rows);
  target_mean_ = std::move(y.mean);
  kernel_ = eval::Product(features_, features_.transpose()).cast<double>();
  scale_ = kernel_.diagonal().mean();
  if (scale_ <= 0) scale_ = 1;
  kernel_ /= scale_;
}

eval::FaceRows DualRegression::Predict(const eval::FaceRows& features, double lambda) const {
  DAUMIER_CHECK(features.cols() == features_.cols(), "{} features, expected {}", features.cols(), features_.cols());
  DAUMIER_CHECK(lambda > 0, "lambda is {}, expected > 0", lambda);
  const eval::FaceRows centred = features.rowwise() - feature_mean_;
  const Eigen::MatrixXd k = eval::Product(centred, features_.transpose()).cast<double>() / scale_;
  Eigen::MatrixXd regularised = kernel_;
  regularised.diagonal().array() += lambda;
  const eval::FaceRows weights = regularised.ldlt().solve(k.transpose()).transpose().cast<float>();
  return eval::Product(weights, targets_).rowwise() + target_mean_;
}

std::vector<double> RegressionLambdas() {
  return {1e-4, 1e-3, 1e-2, 1e-1, 1, 10, 100};
}

}  // namespace daumier::benchmark
