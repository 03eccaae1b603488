#pragma once
#include "geometry/operators.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace daumier::geometry {

/// A surface deformed as rigidly as possible.
struct ArapDeformation {
  Points vertices;               ///< V x 3
  std::vector<double> energies;  ///< At the start and after each iteration; never rises.
};

/// Moves a mesh by some of its vertices, which are fixed [Sorkine and Alexa 2007, eq. 3]: the x' of least
///   E = sum_i sum_j in N(i) w_ij |(x'_i - x'_j) - R_i (x_i - x_j)|^2
/// over positions and rotations R_i in turn, w_ij the cotangent weights (at least kMinCotangent). The system is
/// factorised once, for any targets. Promises: E never rises; targets moved by one rigid motion move the mesh by it
/// at no energy.
class ArapDeformer {
 public:
  /// handle_ids: distinct vertices. @throws Error if an id is out of range or repeated, there is none, a part of the
  /// mesh has no handle, or a triangle has no area.
  ArapDeformer(const TriangleMesh& mesh, std::vector<int> handle_ids);

  /// targets: a row a handle. Starts at the rest shape, or at `start` (V x 3).
  /// @throws Error if a shape disagrees or a target is not finite.
  ArapDeformation Solve(const Points& targets, int iterations = 20, const Points& start = {}) const;

 private:
  std::vector<Eigen::Matrix3d> Rotations(const Points& moved) const;
  double Energy(const Points& moved, const std::vector<Eigen::Matrix3d>& rotations) const;

  Points rest_;
  SparseMatrix laplacian_;  ///< V x V
  std::vector<int> handles_, free_;
  SparseMatrix free_by_handles_;  ///< Rows of free vertices, columns of handles.
  std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> factor_;
};

}  // namespace daumier::geometry
