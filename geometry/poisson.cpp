#include "geometry/poisson.h"

#include "core/error.h"

namespace daumier::geometry {
namespace {

/// The least pivot, as a share of the largest, of a matrix that is not singular. One fixed vertex on a mesh of 20,000
/// vertices leaves pivots above 1e-4; a surface without any leaves one of rounding size.
constexpr double kLeastFreePivot = 1e-11;

}  // namespace

PoissonSolver::PoissonSolver(const SparseMatrix& laplacian, const std::vector<int>& fixed_ids) : fixed_(fixed_ids) {
  const int num_vertices = static_cast<int>(laplacian.rows());
  DAUMIER_CHECK(laplacian.cols() == num_vertices, "the Laplacian is {} x {}, not square", num_vertices,
                laplacian.cols());
  std::vector<int> position(num_vertices,
                            -1);  // Of a fixed vertex among the fixed ones, of a free one among the free ones.
  std::vector<bool> is_fixed(num_vertices);
  for (size_t i = 0; i < fixed_.size(); ++i) {
    DAUMIER_CHECK(fixed_[i] >= 0 && fixed_[i] < num_vertices, "fixed vertex {} is out of range, there are {}",
                  fixed_[i], num_vertices);
    DAUMIER_CHECK(!is_fixed[fixed_[i]], "vertex {} is fixed twice", fixed_[i]);
    is_fixed[fixed_[i]] = true;
    position[fixed_[i]] = static_cast<int>(i);
  }
  for (int v = 0; v < num_vertices; ++v) {
    if (is_fixed[v]) continue;
    position[v] = static_cast<int>(free_.size());
    free_.push_back(v);
  }
  std::vector<Eigen::Triplet<double>> free_block, fixed_block;
  for (int column = 0; column < num_vertices; ++column) {
    for (SparseMatrix::InnerIterator entry(laplacian, column); entry; ++entry) {
      if (is_fixed[entry.row()]) continue;
      auto& block = is_fixed[column] ? fixed_block : free_block;
      block.emplace_back(position[entry.row()], position[column], entry.value());
    }
  }
  const int num_free = static_cast<int>(free_.size());
  free_from_fixed_.resize(num_free, static_cast<int>(fixed_.size()));
  free_from_fixed_.setFromTriplets(fixed_block.begin(), fixed_block.end());
  if (num_free == 0) return;
  SparseMatrix free_from_free(num_free, num_free);
  free_from_free.setFromTriplets(free_block.begin(), free_block.end());
  factor_ = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(free_from_free);
  const bool is_regular = factor_->info() == Eigen::Success &&
                          factor_->vectorD().minCoeff() > kLeastFreePivot * factor_->vectorD().maxCoeff();
  DAUMIER_CHECK(is_regular,
                "the Poisson system of {} free vertices is singular: a part of the surface has no fixed vertex",
                num_free);
}

Eigen::MatrixXd PoissonSolver::Solve(const Eigen::MatrixXd& rhs, const Eigen::MatrixXd& fixed_values) const {
  const auto num_vertices = static_cast<Eigen::Index>(fixed_.size() + free_.size());
  DAUMIER_CHECK(rhs.rows() == num_vertices, "the right-hand side has {} rows, expected {}", rhs.rows(), num_vertices);
  DAUMIER_CHECK(fixed_values.rows() == static_cast<Eigen::Index>(fixed_.size()) && fixed_values.cols() == rhs.cols(),
                "fixed values are {} x {}, expected {} x {}", fixed_values.rows(), fixed_values.cols(), fixed_.size(),
                rhs.cols());
  Eigen::MatrixXd solution(num_vertices, rhs.cols());
  solution(fixed_, Eigen::all) = fixed_values;
  if (free_.empty()) return solution;
  const Eigen::MatrixXd free_rhs = rhs(free_, Eigen::all) - free_from_fixed_ * fixed_values;
  // Evaluated first: Eigen 3.4 gives wrong values if a solve is assigned to an indexed view.
  const Eigen::MatrixXd free_solution = factor_->solve(free_rhs);
  solution(free_, Eigen::all) = free_solution;
  return solution;
}

Eigen::MatrixXd SolvePoisson(const SparseMatrix& laplacian, const std::vector<int>& fixed_ids,
                             const Eigen::MatrixXd& rhs, const Eigen::MatrixXd& fixed_values) {
  return PoissonSolver(laplacian, fixed_ids).Solve(rhs, fixed_values);
}

}  // namespace daumier::geometry
