#pragma once
#include "geometry/operators.h"
#include "geometry/sparse_factor.h"

#include <memory>
#include <vector>

namespace daumier::geometry {

/// The displacement d of a surface that changes its Laplacian coordinates least while some vertices move as given,
///   min_d sum_i |(S d)_i / S_ii|^2   with d_(v_k) = r_k,
/// S a V x V Laplacian. With the uniform Laplacian and x = x0 + d this is Laplacian deformation [Sorkine et al. 2004]
/// without its rotations. The system of the other vertices is factorised once, whatever the moves. Promises: equal moves
/// of all pins move the whole surface by them; no moves change nothing; d is linear in r.
class PinnedDeformation {
 public:
  /// laplacian: symmetric, rows sum to 0. pins: K distinct vertices.
  /// @throws Error if it is not square, an id is out of range or repeated, or a part of the surface has no pin.
  PinnedDeformation(const SparseMatrix& laplacian, std::vector<int> pins);

  /// moves: r, K x 3, any unit. Returns d, V x 3. Thread-safe. @throws Error if a shape disagrees or a move is not finite.
  Points Solve(const Points& moves) const;

  const std::vector<int>& pins() const { return pins_; }

 private:
  std::vector<int> pins_, free_;
  SparseMatrix from_pins_;  ///< F x K: right-hand side by moves of pins.
  std::unique_ptr<const SparseFactor> factor_;
};

}  // namespace daumier::geometry
