#include "geometry/sparse_factor.h"

#include "core/error.h"
#include "geometry/substitution_kernel.h"

#include <Eigen/SparseCholesky>

namespace daumier::geometry {
namespace {

/// The columns behind the third are 0.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, kSolvedColumns, Eigen::RowMajor>;

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
  Rows x = Rows::Zero(right.rows(), kSolvedColumns);
  for (Eigen::Index i = 0; i < right.rows(); ++i) x.row(place_[i]).head<3>() = right.row(i);
  const FactorColumns lower{lower_.outerIndexPtr(), lower_.innerIndexPtr(), lower_.valuePtr()};
  SubstituteForwards(lower, int(x.rows()), x.data());
  SubstituteBackwards(lower, int(x.rows()), x.data());
  Points solution(right.rows(), 3);
  for (Eigen::Index i = 0; i < right.rows(); ++i) solution.row(i) = x.row(place_[i]).head<3>();
  return solution;
}

}  // namespace daumier::geometry
