#pragma once
#include <Eigen/Core>

namespace daumier::fitting {

/// The normal distribution of the codes of some faces, as a change of variables: z = mean + factor c, c ~ N(0, I).
struct CodePrior {
  Eigen::VectorXd mean;     ///< M
  Eigen::MatrixXd factor;   ///< M x M, columns orthogonal, longest first: principal components of the codes.
  double usual_radius = 0;  ///< 99th percentile of |c| over the codes.
};

/// latents: a row a face, M columns. A direction of less than 1e-3 of the mean variance gets that much, so that
/// rounding does not become an axis. @throws Error if there are fewer than two codes, one is not finite, or all are
/// equal.
CodePrior PriorOfCodes(const Eigen::MatrixXd& latents);

/// c of latents, a row a face: undoes z = mean + factor c. @throws Error if sizes differ.
Eigen::MatrixXd StandardisedCodes(const CodePrior& prior, const Eigen::MatrixXd& latents);

/// The 99th percentile of |c| of c ~ N(0, I) in `num_numbers` dimensions [Wilson and Hilferty 1931], to 0.5 %.
double NormalRadius(int num_numbers);

}  // namespace daumier::fitting
