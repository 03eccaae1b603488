#pragma once
#include "geometry/poisson.h"

#include <vector>

namespace daumier::geometry {

/// How a deformation changes the triangles of a mesh. Only those that it changes are listed.
struct DeformationGradients {
  std::vector<int> triangles;  ///< Ascending.
  /// Of each of them S_f - I, where S_f (3 x 3) takes the edges and the unit normal of the reference triangle to those
  /// of the deformed one [Sumner and Popovic 2004, eq. 4, with a normal of unit length].
  std::vector<Eigen::Matrix3d> changes;
};

/// The deformation gradients from `reference` to `deformed` (V x 3, same triangles). Triangles whose S_f - I has no
/// entry beyond `tolerance` are left out.
/// @throws Error if the number of vertices differs, or naming a triangle without area in either.
DeformationGradients ComputeDeformationGradients(const TriangleMesh& reference, const Points& deformed,
                                                 double tolerance = 1e-9);

/// The vertices that none of the poses moves by more than `tolerance` cm from the reference, ascending.
/// @throws Error if a number of vertices differs.
std::vector<int> StaticVertices(const Points& reference, const std::vector<Points>& poses, double tolerance);

/// Carries deformations of one mesh to another one that is registered to it, that is, has the same triangles
/// [Sumner and Popovic 2004, section 3]: the vertices x' of the target that minimise
///   sum_f A_f |S_f - T_f(x')|^2  over the tangent plane of f,
/// T_f the target's own deformation gradients, A_f its rest areas, with the pinned vertices where they are. The part of
/// S_f along the normal is absorbed exactly by a free fourth vertex, so that this is the paper's eq. 8 with the
/// triangles weighted by area [Botsch et al. 2006]; its matrix is the (unclamped) cotangent Laplacian of the target,
/// factorised once here for all deformations.
/// Promises: no deformation returns the target; a deformation carried to its own reference returns the deformed mesh,
/// if what is pinned does not move; a target that is the reference scaled and moved gets the deformation scaled alike.
class DeformationTransfer {
 public:
  /// @throws Error naming a triangle without area, or as PoissonSolver if a part of the surface has no pinned vertex.
  DeformationTransfer(const TriangleMesh& target, const std::vector<int>& pinned_ids);

  /// V x 3: the deformed target. May be called from several threads at once.
  /// @throws Error if a triangle is out of range.
  Points Apply(const DeformationGradients& gradients) const;

 private:
  TriangleMesh target_;
  Points cotangents_;  ///< F x 3, corner by corner.
  PoissonSolver solver_;
  Eigen::MatrixXd still_;  ///< Displacement of the pinned vertices: zero.
};

/// One transfer: DeformationTransfer(target, pinned_ids).Apply(ComputeDeformationGradients(reference, deformed)).
Points TransferDeformation(const TriangleMesh& reference, const Points& deformed, const TriangleMesh& target,
                           const std::vector<int>& pinned_ids);

}  // namespace daumier::geometry
