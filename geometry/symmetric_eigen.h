#pragma once
#include <Eigen/Core>

namespace daumier::geometry {

/// A = V diag(values) V^T.
struct SymmetricEigen {
  Eigen::VectorXd values;   ///< N, smallest first.
  Eigen::MatrixXd vectors;  ///< N x N, orthonormal columns; their signs are arbitrary.
};

/// All eigenvectors of a symmetric N x N matrix, of which the lower triangle is read.
/// @throws Error if it is not square or the iteration does not converge, as with numbers that are not finite.
SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix);

/// The eigenvalues alone, smallest first, in a fraction of the time. @throws Error as DecomposeSymmetric.
Eigen::VectorXd SymmetricEigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace daumier::geometry
