#pragma once
#include <Eigen/Core>

namespace daumier::faces {

struct LeadingEigenvectors {
  Eigen::VectorXd values;   ///< K, greatest first.
  Eigen::MatrixXd vectors;  ///< N x K, orthonormal columns; their signs mean nothing.
};

/// The `count` greatest eigenvalues of a symmetric N x N matrix, of which the lower triangle is read. Where few of many
/// are wanted they come from a Lanczos method with implicit restarts [Sorensen 1992], whose cost grows with N^2 and not
/// with N^3. @throws Error unless 0 < count <= N.
LeadingEigenvectors FindLeadingEigenvectors(const Eigen::MatrixXd& matrix, int count);

}  // namespace daumier::faces
