#include "geometry/pinned_deformation.h"

#include "core/error.h"

#include <utility>

namespace daumier::geometry {
namespace {

/// The rows and columns of a matrix that `row_of` and `column_of` give a place, -1 where they give none.
SparseMatrix Selected(const SparseMatrix& matrix, const std::vector<int>& row_of, const std::vector<int>& column_of,
                      Eigen::Index rows, Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(size_t(matrix.nonZeros()));
  for (Eigen::Index outer = 0; outer < matrix.outerSize(); ++outer)
    for (SparseMatrix::InnerIterator entry(matrix, outer); entry; ++entry)
      if (row_of[size_t(entry.row())] >= 0 && column_of[size_t(entry.col())] >= 0)
        triplets.emplace_back(row_of[size_t(entry.row())], column_of[size_t(entry.col())], entry.value());
  SparseMatrix selected(rows, columns);
  selected.setFromTriplets(triplets.begin(), triplets.end());
  return selected;
}

}  // namespace

PinnedDeformation::PinnedDeformation(const SparseMatrix& laplacian, std::vector<int> pins) : pins_(std::move(pins)) {
  const Eigen::Index num_vertices = laplacian.rows();
  DAUMIER_CHECK(laplacian.cols() == num_vertices, "a Laplacian of {} x {} entries, expected a square one",
                laplacian.rows(), laplacian.cols());
  std::vector<int> pin_of(size_t(num_vertices), -1), free_of(size_t(num_vertices), -1);
  for (size_t k = 0; k < pins_.size(); ++k) {
    const int v = pins_[k];
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "pin {} is out of range, there are {} vertices", v, num_vertices);
    DAUMIER_CHECK(pin_of[size_t(v)] < 0, "vertex {} is pinned twice", v);
    pin_of[size_t(v)] = int(k);
  }
  for (int v = 0; v < num_vertices; ++v) {
    if (pin_of[size_t(v)] >= 0) continue;
    free_of[size_t(v)] = int(free_.size());
    free_.push_back(v);
  }
  const Eigen::VectorXd scale = laplacian.diagonal().cwiseInverse();
  const SparseMatrix rows = scale.asDiagonal() * laplacian;
  const SparseMatrix energy = rows.transpose() * rows;
  from_pins_ = -Selected(energy, free_of, pin_of, Eigen::Index(free_.size()), Eigen::Index(pins_.size()));
  const SparseMatrix of_free =
      Selected(energy, free_of, free_of, Eigen::Index(free_.size()), Eigen::Index(free_.size()));
  auto factor = std::make_unique<SparseFactor>(of_free);
  DAUMIER_CHECK(factor->is_positive(),
                "{} pins do not hold the surface: each part of it needs one, and each vertex a triangle", pins_.size());
  factor_ = std::move(factor);
}

Points PinnedDeformation::Solve(const Points& moves) const {
  DAUMIER_CHECK(moves.rows() == Eigen::Index(pins_.size()), "{} moves for {} pins", moves.rows(), pins_.size());
  DAUMIER_CHECK(moves.allFinite(), "a pin's move is not finite");
  const Points solution = factor_->Solve(from_pins_ * moves);
  Points displacement(Eigen::Index(free_.size() + pins_.size()), 3);
  for (size_t f = 0; f < free_.size(); ++f) displacement.row(free_[f]) = solution.row(Eigen::Index(f));
  for (size_t k = 0; k < pins_.size(); ++k) displacement.row(pins_[k]) = moves.row(Eigen::Index(k));
  return displacement;
}

}  // namespace daumier::geometry
