#include "geometry/sparse_factor.h"

#include "core/error.h"

#include <Eigen/SparseCholesky>

namespace daumier::geometry {
namespace {

/// Rows of four numbers fill vector registers; the fourth is 0.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

void SubstituteForwards(const SparseMatrix& lower, Rows& x) {
  const int* const starts = lower.outerIndexPtr();
  const int* const rows = lower.innerIndexPtr();
  const double* const values = lower.valuePtr();
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    const Eigen::RowVector4d solved = x.row(j) / values[starts[j]];
    x.row(j) = solved;
    for (int entry = starts[j] + 1; entry < starts[j + 1]; ++entry) x.row(rows[entry]) -= values[entry] * solved;
  }
}

void SubstituteBackwards(const SparseMatrix& lower, Rows& x) {
  const int* const starts = lower.outerIndexPtr();
  const int* const rows = lower.innerIndexPtr();
  const double* const values = lower.valuePtr();
  for (Eigen::Index j = lower.cols() - 1; j >= 0; --j) {
    Eigen::RowVector4d sum = x.row(j);
    for (int entry = starts[j] + 1; entry < starts[j + 1]; ++entry) sum -= values[entry] * x.row(rows[entry]);
    x.row(j) = sum / values[starts[j]];
  }
}

}  // namespace

SparseFactor::SparseFactor(const SparseMatrix& matrix) {
  DAUMIER_CHECK(matrix.rows() == matrix.cols(), "a matrix of {} x {} entries is factorised, expected a square one",
                matrix.rows(), matrix.cols());
  const Eigen::SimplicialLLT<SparseMatrix> factor(matrix);
  is_positive_ = factor.info() == Eigen::Success;
  if (!is_positive_) return;
  place_ = factor.permutationP().indices();
  lower_ = factor.matrixL().nestedExpression();
}

Points SparseFactor::Solve(const Points& right) const {
  DAUMIER_CHECK(is_positive_, "the system is not positive definite");
  DAUMIER_CHECK(right.rows() == lower_.rows(), "{} rows on the right-hand side of {} equations", right.rows(),
                lower_.rows());
  Rows x = Rows::Zero(right.rows(), 4);
  for (Eigen::Index i = 0; i < right.rows(); ++i) x.row(place_[i]).head<3>() = right.row(i);
  SubstituteForwards(lower_, x);
  SubstituteBackwards(lower_, x);
  Points solution(right.rows(), 3);
  for (Eigen::Index i = 0; i < right.rows(); ++i) solution.row(i) = x.row(place_[i]).head<3>();
  return solution;
}

}  // namespace daumier::geometry
