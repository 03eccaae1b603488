#include "fitting/handle_quadratic.h"

#include "core/error.h"

#include <Eigen/LU>

namespace daumier::fitting {
namespace {

using Eigen::Index;

/// Solves a symmetric positive definite tridiagonal system in place, a right-hand side a column.
void SolveTridiagonal(Eigen::VectorXd diagonal, const Eigen::VectorXd& off_diagonal, Eigen::MatrixXd& sides) {
  const Index size = diagonal.size();
  for (Index i = 1; i < size; ++i) {
    const double factor = off_diagonal[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * off_diagonal[i - 1];
    sides.row(i) -= factor * sides.row(i - 1);
  }
  for (Index i = size - 1; i >= 0; --i) {
    if (i + 1 < size) sides.row(i) -= off_diagonal[i] * sides.row(i + 1);
    sides.row(i) /= diagonal[i];
  }
}

}  // namespace

HandleQuadratic::HandleQuadratic(const Eigen::MatrixXd& handle_rows, const Eigen::MatrixXd& outside_rows)
    : outside_rows_(outside_rows), handle_rows_(handle_rows) {
  if (outside_rows.rows() == 0) return;
  DAUMIER_CHECK(outside_rows.cols() == handle_rows.cols(), "handles move {} numbers, the outside {}",
                handle_rows.cols(), outside_rows.cols());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(outside_rows.cols(), outside_rows.cols());
  normal.selfadjointView<Eigen::Lower>().rankUpdate(outside_rows.transpose());
  tridiagonal_.emplace(normal);
  handle_rows_ = (tridiagonal_->matrixQ().adjoint() * handle_rows.transpose()).transpose();
}

Eigen::VectorXd HandleQuadratic::Minimum(const Eigen::VectorXd& handle_moves, const Eigen::VectorXd& outside_moves,
                                         const Deviations& deviations) const {
  const Index num_rows = handle_rows_.rows();
  DAUMIER_CHECK(handle_moves.size() == num_rows, "{} moves of handles, expected {}", handle_moves.size(), num_rows);
  const double handle_weight = 1 / (deviations.handle * deviations.handle),
               outside_weight = 1 / (deviations.outside * deviations.outside);
  // The columns of K^-1 [H^T, q], K = I + T / s_o^2 and q = O^T o / s_o^2, in the basis.
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(handle_rows_.cols(), num_rows + 1);
  sides.leftCols(num_rows) = handle_rows_.transpose();
  if (outside_moves.size() > 0) {
    DAUMIER_CHECK(outside_moves.size() == outside_rows_.rows(), "{} moves of the outside, expected {}",
                  outside_moves.size(), outside_rows_.rows());
    const Eigen::VectorXd pull = outside_weight * (outside_rows_.transpose() * outside_moves);
    sides.col(num_rows) = tridiagonal_->matrixQ().adjoint() * pull;
  }
  if (tridiagonal_)
    SolveTridiagonal((1 + outside_weight * tridiagonal_->diagonal().array()).matrix(),
                     outside_weight * tridiagonal_->subDiagonal(), sides);
  // y = K^-1 (q + H^T force) with force = (h - H y) / s^2.
  Eigen::MatrixXd small = handle_weight * (handle_rows_ * sides.leftCols(num_rows));
  small.diagonal().array() += 1;
  const Eigen::VectorXd missing = handle_moves - handle_rows_ * sides.col(num_rows),
                        force = small.partialPivLu().solve(handle_weight * missing);
  const Eigen::VectorXd moved = sides.col(num_rows) + sides.leftCols(num_rows) * force;
  if (!tridiagonal_) return moved;
  return tridiagonal_->matrixQ() * moved;
}

}  // namespace daumier::fitting
