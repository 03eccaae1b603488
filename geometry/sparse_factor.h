#pragma once
#include "geometry/operators.h"

#include <Eigen/Core>

namespace daumier::geometry {

/// A symmetric positive definite system that is factorised once, P A P' = L L' [Davis 2006, chapter 4], and solved for
/// three right-hand sides at a time: each entry of L is read once a substitution, not once a column.
class SparseFactor {
 public:
  /// matrix: N x N, of which the lower triangle is read. @throws Error if it is not square.
  explicit SparseFactor(const SparseMatrix& matrix);

  /// False if the matrix is not positive definite; there is no solution then.
  bool is_positive() const { return is_positive_; }
  /// X with A X = B, both N x 3. Thread-safe. @throws Error if the number of rows differs, or without is_positive().
  Points Solve(const Points& right) const;

 private:
  Eigen::VectorXi place_;  ///< Of each row in L.
  SparseMatrix lower_;     ///< By columns; the diagonal is the first entry of each.
  bool is_positive_ = false;
};

}  // namespace daumier::geometry
