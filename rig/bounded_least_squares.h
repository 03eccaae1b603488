#pragma once
#include <Eigen/Core>

namespace daumier::rig {

/// Least squares within bounds: argmin_x |A x - b|^2, 0 <= x_i <= most_i, by active sets [Lawson and Hanson 1974, chapter 23;
/// Stark and Parker 1995]. Without upper bounds (infinity) it is non-negative least squares.
/// gram: A^T A, n x n; right: A^T b, n; most: n. At the solution the gradient g = A^T (b - A x) is 0 where 0 < x_i < most_i,
/// not positive where x_i = 0 and not negative where x_i = most_i. A variable whose column is 0 (shorter than a
/// millionth of the longest) or depends linearly on columns that are in use stays at its bound.
/// @throws Error if a shape disagrees, a number of `gram` or `right` is not finite, or an upper bound is negative.
Eigen::VectorXd BoundedLeastSquares(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                                    const Eigen::VectorXd& most);

}  // namespace daumier::rig
