#include "geometry/laplacian_anchors.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace daumier::geometry {
namespace {

/// Right-hand sides that are substituted together: a row of them is read at once.
constexpr Eigen::Index kColumnsTogether = 64;
/// The least pivot, as a share of the largest, of a connected surface with one vertex held.
constexpr double kLeastHeldPivot = 1e-6;

/// The block of all vertices but the last.
SparseMatrix WithoutLast(const SparseMatrix& laplacian) {
  const Eigen::Index count = laplacian.cols() - 1;
  return laplacian.topLeftCorner(count, count);
}

}  // namespace

LaplacianAnchors::LaplacianAnchors(const SparseMatrix& laplacian, std::vector<int> anchor_ids, AnchorUse use)
    : anchors_(std::move(anchor_ids)) {
  const Eigen::Index num_vertices = laplacian.rows(), num_anchors(anchors_.size());
  DAUMIER_CHECK(laplacian.cols() == num_vertices && num_vertices > 1, "the Laplacian is {} x {}, not square",
                num_vertices, laplacian.cols());
  std::vector<bool> is_anchor(size_t(num_vertices), false);
  for (const int v : anchors_) {
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "anchor {} is out of range, there are {} vertices", v, num_vertices);
    DAUMIER_CHECK(!is_anchor[size_t(v)], "vertex {} is an anchor twice", v);
    is_anchor[size_t(v)] = true;
  }
  factor_ = std::make_unique<Factor>(WithoutLast(laplacian));
  double least = 0, largest = 0;
  if (factor_->info() == Eigen::Success) {
    const Eigen::VectorXd pivots = SparseMatrix(factor_->matrixL()).diagonal();
    least = pivots.minCoeff(), largest = pivots.maxCoeff();
  }
  DAUMIER_CHECK(least > kLeastHeldPivot * largest, "the surface of {} vertices is not connected", num_vertices);
  squares_ = laplacian.diagonal().array().square();

  Rows ends = Rows::Zero(num_vertices, num_anchors);
  for (Eigen::Index k = 0; k < num_anchors; ++k) ends(anchors_[size_t(k)], k) = 1;
  // With forces that sum to 0 any constant may be added to a column; so that its change sums to 0, this one is.
  Rows changes = Substitute(ends);
  changes.rowwise() -= (squares_.transpose() * changes / squares_.sum()).eval();
  const Rows scaled = squares_.cwiseSqrt().asDiagonal() * changes;
  gram_ = scaled.transpose() * scaled;
  changes_ = squares_.asDiagonal() * changes;
  if (use == AnchorUse::kOnce) return;
  columns_ = Substitute(changes_);
  changes_.resize(0, 0);
  factor_.reset();
}

LaplacianAnchors::Rows LaplacianAnchors::Substitute(const Rows& rhs) const {
  const SparseMatrix& lower = factor_->matrixL().nestedExpression();
  const Eigen::Index count = lower.cols();
  Rows solution = Rows::Zero(rhs.rows(), rhs.cols());
  for (Eigen::Index first = 0; first < rhs.cols(); first += kColumnsTogether) {
    const Eigen::Index together = std::min(kColumnsTogether, rhs.cols() - first);
    Rows x = factor_->permutationP() * rhs.block(0, first, count, together);
    for (Eigen::Index j = 0; j < count; ++j) {
      SparseMatrix::InnerIterator entry(lower, j);  // The first of a column is its diagonal.
      x.row(j) /= entry.value();
      for (++entry; entry; ++entry) x.row(entry.row()).noalias() -= entry.value() * x.row(j);
    }
    for (Eigen::Index j = count - 1; j >= 0; --j) {
      SparseMatrix::InnerIterator entry(lower, j);
      const double diagonal = entry.value();
      for (++entry; entry; ++entry) x.row(j).noalias() -= entry.value() * x.row(entry.row());
      x.row(j) /= diagonal;
    }
    solution.block(0, first, count, together) = factor_->permutationPinv() * x;
  }
  return solution;
}

LaplacianAnchors::Forces LaplacianAnchors::SolveForces(const Points& moves, const Eigen::VectorXd& weights) const {
  const Eigen::Index num_anchors(anchors_.size());
  DAUMIER_CHECK(moves.rows() == num_anchors && weights.size() == num_anchors, "{} moves and {} weights of {} anchors",
                moves.rows(), weights.size(), num_anchors);
  std::vector<Eigen::Index> used;
  for (Eigen::Index k = 0; k < num_anchors; ++k) {
    DAUMIER_CHECK(weights[k] >= 0 && std::isfinite(weights[k]), "anchor {} has the weight {}", k, weights[k]);
    if (weights[k] == 0) continue;
    DAUMIER_CHECK(moves.row(k).allFinite(), "the move of anchor {} is not finite", k);
    used.push_back(k);
  }
  DAUMIER_CHECK(!used.empty(), "none of {} anchors has a weight", num_anchors);
  // Where d = Q f + shift: (Q + 1/w) f + shift = r, and the forces sum to 0.
  const Eigen::Index count(used.size());
  Eigen::MatrixXd system(count, count);
  Eigen::MatrixXd targets(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) system(i, j) = gram_(used[size_t(i)], used[size_t(j)]);
    system(i, i) += 1 / weights[used[size_t(i)]];
    targets.row(i) << moves.row(used[size_t(i)]), 1;
  }
  const Eigen::MatrixXd solved = system.llt().solve(targets);
  Forces result;
  result.shift = solved.leftCols<3>().colwise().sum() / solved.col(3).sum();
  result.forces = Points::Zero(num_anchors, 3);
  for (Eigen::Index i = 0; i < count; ++i)
    result.forces.row(used[size_t(i)]) = solved.row(i).head<3>() - solved(i, 3) * result.shift;
  result.at_anchors = gram_ * result.forces;
  return result;
}

Points LaplacianAnchors::SolveAnchors(const Points& moves, const Eigen::VectorXd& weights) const {
  const Forces solved = SolveForces(moves, weights);
  return solved.at_anchors.rowwise() + solved.shift;
}

Points LaplacianAnchors::Solve(const Points& moves, const Eigen::VectorXd& weights) const {
  const Forces solved = SolveForces(moves, weights);
  Points displacement;
  if (factor_ == nullptr) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(columns_.rows(), 3);
    for (Eigen::Index k = 0; k < columns_.cols(); ++k) {
      if (weights[k] > 0) sum.noalias() += columns_.col(k) * solved.forces.row(k);
    }
    displacement = sum;
  } else {
    displacement = Substitute(changes_ * solved.forces);
  }
  // The constant that is left is the same for all anchors.
  Eigen::RowVector3d constant = solved.shift;
  for (size_t k = 0; k < anchors_.size(); ++k)
    constant += (solved.at_anchors.row(Eigen::Index(k)) - displacement.row(anchors_[k])) / double(anchors_.size());
  displacement.rowwise() += constant;
  return displacement;
}

}  // namespace daumier::geometry
