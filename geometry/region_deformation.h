#pragma once
#include "geometry/operators.h"
#include "geometry/substitution_kernel.h"

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace daumier::geometry {

/// What deformations of regions need of a surface at rest.
struct SurfaceStiffness {
  SparseMatrix laplacian;  ///< L, V x V: CotangentLaplacian, clamped.
  Eigen::VectorXd areas;   ///< m, V, cm^2: VertexAreas.
  SparseMatrix bending;    ///< L diag(m)^-1 L, V x V.
};

/// @throws Error if a vertex has no triangle, or as CotangentLaplacian.
SurfaceStiffness MakeSurfaceStiffness(const TriangleMesh& rest);

/// Smooth displacements d of a region of a surface, by handles; all other vertices have d = 0. Least is
///   E(d) = sum_i m_i ((L d)_i / m_i + d_i / reach^2)^2   over all vertices i of the surface.
/// Without the second term this is Laplacian deformation without rotations [Sorkine et al. 2004]. The second one makes a
/// displacement fade with the distance r from handles, on a plane as (1 + r / reach) exp(-r / reach), so that a
/// region needs no fixed vertex: a reach far beyond the region's size leaves that to its border. Vertices outside count
/// in E too, which makes d leave the border of the region with slope 0. E is factorised once, whatever the handles.
/// Linear in moves. Thread-safe.
class RegionDeformation {
 public:
  /// region: R distinct vertices. reach: cm. @throws Error if the region is empty, an id is out of range or repeated, or
  /// the reach is not positive.
  RegionDeformation(const SurfaceStiffness& stiffness, std::vector<int> region, double reach);

  const std::vector<int>& region() const { return region_; }

  /// d of least E with d = moves at the handles, exactly: R x C, in the order of the region. handles: K distinct
  /// vertices of the region; moves: K x C. Of the handles, those that are coupled to a free vertex, within two edges,
  /// cost a substitution each, up to 400; then the free vertices are factorised. @throws Error if a handle is repeated or not in the region, a shape disagrees, there is
  /// no handle, or a move is not finite.
  Eigen::MatrixXd Solve(const std::vector<int>& handles, const Eigen::MatrixXd& moves) const;

  /// A dome over the handles: the d of least E(d) - 2 sum_k m_k d_k, a plate under equal pressure on the handles, scaled
  /// to a maximum of 1. R. @throws Error as Solve.
  Eigen::VectorXd Dome(const std::vector<int>& handles) const;

 private:
  using Factor = Eigen::SimplicialLLT<SparseMatrix>;

  /// Solutions of (lower factor) x = unit vectors: rows that are not 0.
  struct UnitSolutions {
    std::vector<int> rows;       ///< Ascending.
    std::vector<int> firsts;     ///< Of each block of kBlockColumns columns the first row that is not 0, in `rows`.
    std::vector<double> values;  ///< A block behind the other.

    const double* block(size_t b) const { return values.data() + b * rows.size() * kBlockColumns; }
    Eigen::MatrixXd Gram(Eigen::Index size) const;
    /// The solutions by a matrix with a row for each.
    Eigen::MatrixXd Times(const Eigen::MatrixXd& right) const;
  };

  std::vector<int> Places(const std::vector<int>& handles) const;
  /// places: in the order of their rows in the factor.
  UnitSolutions SubstituteUnits(const std::vector<int>& places) const;
  /// d of least E with these values at places, which are right up to rounding. R x C.
  Eigen::MatrixXd SolveCoupled(const std::vector<int>& places, const Eigen::MatrixXd& moves) const;
  /// The rows of free vertices, 0 before.
  void SolveFree(Eigen::MatrixXd& displacement, const std::vector<bool>& is_handle) const;

  std::vector<int> region_;
  std::vector<int> place_of_vertex_;  ///< V: row in the region; -1 outside.
  Eigen::VectorXd areas_;             ///< R
  SparseMatrix energy_;               ///< R x R
  std::unique_ptr<const Factor> factor_;
};

}  // namespace daumier::geometry
