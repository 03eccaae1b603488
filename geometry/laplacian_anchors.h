#pragma once
#include "geometry/operators.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace daumier::geometry {

/// How many displacements are solved for.
enum class AnchorUse {
  kOnce,   ///< Every solve substitutes in the factor.
  kOften,  ///< The displacement by each anchor is stored, V x K: a solve is a K x K system and one product.
};

/// The displacement d of a surface that changes its Laplacian coordinates least and moves anchors,
///   min_d sum_i |(S d)_i / S_ii|^2 + sum_k w_k |d_(v_k) - r_k|^2,
/// S a V x V Laplacian: (S d)_i / S_ii is d_i less the (weighted) mean of its neighbours. With the uniform Laplacian and
/// x = x0 + d this is Laplacian deformation [Pan et al. 2024, eq. 9 and 10] of x0. S is factorised once, whatever the
/// weights: with S S_ii^-2 S d = sum_k f_k at the anchors, forces f_k = w_k (r_k - d_(v_k)) that sum to 0 follow from a
/// K x K system. Promises: equal moves of all anchors move the whole surface by them; the larger w, the nearer an anchor
/// comes to its move.
class LaplacianAnchors {
 public:
  /// laplacian: symmetric, rows sum to 0, of a connected surface. anchor_ids: K distinct vertices.
  /// @throws Error if it is not square, the surface is not connected, or an id is out of range or repeated.
  LaplacianAnchors(const SparseMatrix& laplacian, std::vector<int> anchor_ids, AnchorUse use = AnchorUse::kOften);

  /// moves: r, K x 3; weights: K, >= 0. An anchor of weight 0 is ignored, whatever its move. Returns V x 3.
  /// @throws Error if a shape disagrees, a weight is negative, a move that counts is not finite, or no anchor counts.
  Points Solve(const Points& moves, const Eigen::VectorXd& weights) const;
  /// The rows of Solve at the anchors, K x 3, without the others.
  Points SolveAnchors(const Points& moves, const Eigen::VectorXd& weights) const;

  int num_anchors() const { return int(anchors_.size()); }

 private:
  using Factor = Eigen::SimplicialLLT<SparseMatrix>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Forces {
    Points forces;             ///< K x 3, columns sum to 0.
    Points at_anchors;         ///< K x 3: Q forces, displacements of the anchors but for `shift`.
    Eigen::RowVector3d shift;  ///< Of the anchors.
  };

  /// x of S x = rhs with x = 0 at the last vertex, each column of the right-hand side of its own.
  Rows Substitute(const Rows& rhs) const;
  Forces SolveForces(const Points& moves, const Eigen::VectorXd& weights) const;

  const std::vector<int> anchors_;
  Eigen::VectorXd squares_;  ///< V: S_ii^2
  std::unique_ptr<Factor> factor_;
  Rows changes_;  ///< V x K: Laplacian coordinates by a unit force at each anchor, times S_ii^2; columns sum to 0.
  Eigen::MatrixXd gram_;     ///< K x K: Q, displacements of anchors by unit forces, up to a constant.
  Eigen::MatrixXd columns_;  ///< V x K with kOften: displacements by unit forces, up to a constant.
};

}  // namespace daumier::geometry
