#pragma once
#include <Eigen/Core>

namespace daumier::fitting {

/// Places of N variables, one a row, for a quadratic surface: a central composite design [Box and Wilson 1951] of the 2^N
/// corners at -0.7 and 0.7, the 2 N ends of the axes at -1 and 1, and the middle.
Eigen::MatrixXd CompositeDesign(int num_variables);

/// Places first .. first + count - 1, one a row, of a sequence that fills [-1, 1]^N more evenly than random numbers: the
/// additive recurrence of the powers 1 / g, 1 / g^2 ... 1 / g^N where g^(N + 1) = g + 1 [Roberts 2018].
Eigen::MatrixXd SpreadDesign(int num_variables, int first, int count);

/// A quadratic function, value + gradient^T x + x^T hessian x / 2: what is left of a noisy function near a place.
struct QuadraticSurface {
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;  ///< Symmetric.

  double At(const Eigen::VectorXd& x) const;
  /// The place of [-1, 1]^N where it is lowest, by projected gradient descent from the lowest of its corners, ends of
  /// axes and middle.
  Eigen::VectorXd LowestInBox() const;
};

/// The least squares fit to values at places, one a row. weights: of the squares, at least 0; empty: 1.
/// @throws Error unless there are as many values as places and at least (N + 1) (N + 2) / 2, all finite, and as many
/// weights or none.
QuadraticSurface FitQuadraticSurface(const Eigen::MatrixXd& places, const Eigen::VectorXd& values,
                                     const Eigen::VectorXd& weights = {});

}  // namespace daumier::fitting
