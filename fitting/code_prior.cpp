#include "fitting/code_prior.h"

#include "core/error.h"
#include "core/statistics.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

namespace daumier::fitting {

CodePrior PriorOfCodes(const Eigen::MatrixXd& latents) {
  DAUMIER_CHECK(latents.rows() >= 2 && latents.cols() > 0, "a distribution of {} codes, expected two or more",
                latents.rows());
  DAUMIER_CHECK(latents.allFinite(), "a code has a number that is not finite");
  CodePrior prior;
  prior.mean = latents.colwise().mean().transpose();
  const Eigen::MatrixXd centred = latents.rowwise() - prior.mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred.transpose() * centred / double(latents.rows()));
  const double mean_variance = solver.eigenvalues().mean();
  DAUMIER_CHECK(mean_variance > 0, "all {} codes are equal", latents.rows());
  constexpr double kLeastShare = 1e-3;
  const Eigen::VectorXd deviations = solver.eigenvalues().cwiseMax(kLeastShare * mean_variance).cwiseSqrt().reverse();
  const Eigen::MatrixXd axes = solver.eigenvectors().rowwise().reverse();
  prior.factor = axes * deviations.asDiagonal();
  const Eigen::MatrixXd standardised = centred * axes * deviations.cwiseInverse().asDiagonal();
  std::vector<double> lengths(size_t(standardised.rows()));
  Eigen::VectorXd::Map(lengths.data(), standardised.rows()) = standardised.rowwise().norm();
  prior.usual_radius = Percentile(lengths, 99);
  return prior;
}

Eigen::MatrixXd StandardisedCodes(const CodePrior& prior, const Eigen::MatrixXd& latents) {
  DAUMIER_CHECK(latents.cols() == prior.mean.size(), "codes of {} numbers, expected {}", latents.cols(),
                prior.mean.size());
  const Eigen::VectorXd squared = prior.factor.colwise().squaredNorm().transpose();
  return (latents.rowwise() - prior.mean.transpose()) * prior.factor * squared.cwiseInverse().asDiagonal();
}

double NormalRadius(int num_numbers) {
  DAUMIER_CHECK(num_numbers > 0, "{} dimensions of a normal distribution, expected one or more", num_numbers);
  constexpr double kQuantile = 2.3263;  // Of 0.99.
  const double spread = 2.0 / (9.0 * num_numbers);
  return std::sqrt(num_numbers * std::pow(1 - spread + kQuantile * std::sqrt(spread), 3));
}

}  // namespace daumier::fitting
