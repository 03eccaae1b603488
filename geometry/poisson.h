#pragma once
#include "geometry/operators.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace daumier::geometry {

/// Solves L x = b in the rows of the free vertices with x given at the fixed ones, for one symmetric positive
/// semidefinite L (V x V) and many right-hand sides: the block of the free vertices is factorised once.
class PoissonSolver {
 public:
  /// `fixed_ids` are distinct vertices in any order.
  /// @throws Error if L is not square, an id is out of range or repeated, or a part of the surface has no fixed vertex.
  PoissonSolver(const SparseMatrix& laplacian, const std::vector<int>& fixed_ids);

  /// rhs: V x N (rows of fixed vertices are ignored), fixed_values: as many rows as fixed ids, in their order, x
  /// N. Returns V x N with the fixed values unchanged. @throws Error if a shape disagrees.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& rhs, const Eigen::MatrixXd& fixed_values) const;

 private:
  std::vector<int> fixed_, free_;
  SparseMatrix free_from_fixed_;  ///< Free rows, fixed columns.
  std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> factor_;
};

/// One solve: PoissonSolver(laplacian, fixed_ids).Solve(rhs, fixed_values).
Eigen::MatrixXd SolvePoisson(const SparseMatrix& laplacian, const std::vector<int>& fixed_ids,
                             const Eigen::MatrixXd& rhs, const Eigen::MatrixXd& fixed_values);

}  // namespace daumier::geometry
