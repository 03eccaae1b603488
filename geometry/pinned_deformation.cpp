#include "geometry/pinned_deformation.h"

#include "core/error.h"
#include "geometry/submatrix.h"

#include <utility>

namespace daumier::geometry {

PinnedDeformation::PinnedDeformation(const SparseMatrix& laplacian, std::vector<int> pins) : pins_(std::move(pins)) {
  const Eigen::Index num_vertices = laplacian.rows();
  DAUMIER_CHECK(laplacian.cols() == num_vertices, "a Laplacian of {} x {} entries, expected a square one",
                laplacian.rows(), laplacian.cols());
  std::vector<bool> is_pin(size_t(num_vertices), false);
  std::vector<int> free_of(size_t(num_vertices), -1);
  for (const int v : pins_) {
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "pin {} is out of range, there are {} vertices", v, num_vertices);
    DAUMIER_CHECK(!is_pin[size_t(v)], "vertex {} is pinned twice", v);
    is_pin[size_t(v)] = true;
  }
  for (int v = 0; v < num_vertices; ++v) {
    if (is_pin[size_t(v)]) continue;
    free_of[size_t(v)] = int(free_.size());
    free_.push_back(v);
  }
  const Eigen::VectorXd scale = laplacian.diagonal().cwiseInverse();
  const SparseMatrix rows = scale.asDiagonal() * laplacian;
  const SparseMatrix energy = rows.transpose() * rows;
  from_pins_ = -Submatrix(energy, free_of, std::ssize(free_), pins_);
  auto factor = std::make_unique<SparseFactor>(Submatrix(energy, free_of, std::ssize(free_), free_));
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
