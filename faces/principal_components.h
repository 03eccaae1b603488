#pragma once
#include <Eigen/Core>

#include <functional>
#include <span>

namespace daumier::faces {

enum class Centring { kNone, kMean };

/// The Gram matrix G = X X^T of faces X (N x D, coordinates face(i) of D numbers), N x N, in the unit of the faces
/// squared; with Centring::kMean of X minus its mean row. Summed in double over blocks of coordinates, so that no
/// second copy of the faces is held. @throws Error naming a face of another number of coordinates.
Eigen::MatrixXd GramMatrix(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                           Centring centring);

/// Principal components by the method of snapshots [Sirovich 1987]: of faces X with G = X X^T = U S U^T the rows of
/// W^T X, W = U S^-1/2, are orthonormal.
struct SnapshotComponents {
  Eigen::VectorXd variances;  ///< K, diagonal of S, greatest first.
  Eigen::MatrixXd weights;    ///< N x K, W; signs are arbitrary.
};

/// The first components, at most `most` and only those with more than `least_share` of the first one's variance: the
/// others are rounding. @throws Error unless 0 < most <= N.
SnapshotComponents FindComponents(const Eigen::MatrixXd& gram, int most, double least_share);

/// Fixes the sign of a vector: its entry of largest magnitude becomes positive.
template <class Vector>
void FixSign(Vector&& vector) {
  Eigen::Index largest = 0;
  vector.cwiseAbs().maxCoeff(&largest);
  if (vector(largest) < 0) vector *= -1;
}

}  // namespace daumier::faces
