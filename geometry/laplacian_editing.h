#pragma once
#include "geometry/operators.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace daumier::geometry {

/// Moves a mesh by some of its vertices and keeps its details [Sorkine et al. 2004, eq. 5 and 10]: the x' that minimise
///   sum_i |T_i d_i - (x'_i - m'_i)|^2 + sum_k w_k |x'_k - u_k|^2,   d_i = x_i - m_i,
/// m_i the mean of the neighbours of vertex i, u_k the targets of the handles and T_i = s_i I + [h_i]x the linearised
/// similarity that maps vertex i and its neighbours to their new places best, itself linear in x'. So turning and
/// scaling are free unknowns. The system (3V x 3V) is factorised once.
/// A vertex with fewer than four neighbours, on a border, is fitted over two rings: so few points would follow almost
/// any move of theirs, and the tip of a border would be loose. Promises: targets at the handles' own places give the
/// mesh back; targets that are moved by one map x -> s x + h x x + t (scales, shifts, and rotations to first order)
/// move the whole mesh by it, exactly. A rotation by a large angle a bends the surface by the order of a^2: turn the
/// mesh by AlignSimilarity before.
class LaplacianEditor {
 public:
  /// handle_ids: distinct vertices. weights: w_k > 0 a handle; a large one (1e4) makes its handle as good as hard.
  /// @throws Error if an id is out of range or repeated, a weight is not positive, a vertex has no triangle, or the
  /// handles do not hold the mesh (fewer than three that are not in one line, on each part of it).
  LaplacianEditor(const TriangleMesh& mesh, const std::vector<int>& handle_ids, const Eigen::VectorXd& weights);

  /// targets: a row a handle. Returns V x 3. @throws Error if a shape disagrees or a target is not finite.
  Points Solve(const Points& targets) const;

 private:
  std::vector<int> handles_;
  Eigen::VectorXd weights_;
  int num_vertices_;
  std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> factor_;
};

/// One edit: LaplacianEditor(mesh, handle_ids, weights).Solve(targets).
Points EditLaplacian(const TriangleMesh& mesh, const std::vector<int>& handle_ids, const Eigen::VectorXd& weights,
                     const Points& targets);

/// 3V x 3V: the operator whose rows 3i .. 3i + 2 are (x'_i - m'_i) - T_i(x') d_i of the energy above, for coordinates
/// x0 y0 z0 x1 ... @throws Error if a vertex has no triangle.
SparseMatrix DetailOperator(const TriangleMesh& mesh);

}  // namespace daumier::geometry
