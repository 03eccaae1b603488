#pragma once
#include "geometry/mesh.h"
#include "rig/weight_solver.h"

namespace daumier::rig {

/// The expression of a mesh of a head that is known at rest.
struct MeshWeights {
  Eigen::VectorXd weights;        ///< 52
  Eigen::Matrix3d rotation;       ///< mesh = rotation * expression + translation.
  geometry::Vector3 translation;  ///< cm
  DisplacementError error;        ///< Of the weights, after the motion of the head is taken out.
  DisplacementError at_rest;      ///< Of weight 0, after the motion that fits best without an expression.
};

/// Weights and rigid motion of a head whose targets `solver` has:
///   argmin sum_v m_v |R (rest_v + sum_t w_t o_tv) + t - mesh_v|^2
/// by Gauss-Newton steps, in each of which the weights keep their bounds. rest, mesh: V x 3, cm, the same vertices.
/// Moving the mesh as one piece changes no weight. @throws Error as WeightSolver::Solve, or if the numbers of vertices differ.
MeshWeights WeightsOfMesh(const WeightSolver& solver, const geometry::Points& rest, const geometry::Points& mesh);

}  // namespace daumier::rig
