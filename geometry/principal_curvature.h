#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <functional>

namespace daumier::geometry {

/// The curvature tensor at every vertex, diagonal in directions tangent to the surface.
struct PrincipalCurvatures {
  Points normals;                 ///< V x 3, VertexNormals.
  Eigen::VectorXd k1, k2;         ///< V, 1/cm, |k1| >= |k2|; positive where an outward surface is convex.
  Points direction1, direction2;  ///< V x 3, unit length; direction2 = normal x direction1.
};

/// Solves a symmetric positive definite system W x = m; false if W is singular.
using TensorSolver = std::function<bool(const Eigen::Matrix3d& w, Eigen::Vector3d& m_then_x)>;

/// By LDL^T; a system counts as singular if a pivot is not positive.
bool SolveLdlt(const Eigen::Matrix3d& w, Eigen::Vector3d& m_then_x);

/// Curvature by finite differences of normals [Rusinkiewicz 2004, section 2.2]: in each triangle the tensor that best
/// explains how the normal changes along its three edges; at a vertex the mean of its triangles' tensors, rotated into
/// its tangent plane and weighted by their corner areas. 0 at vertices without a triangle that has area.
/// `solve` solves the systems of the triangles; a triangle whose system is singular is left out.
PrincipalCurvatures ComputePrincipalCurvatures(const TriangleMesh& mesh, const TensorSolver& solve = SolveLdlt);

/// V x 4.
using CurvatureDerivatives = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// V x 4: the derivative of the curvature tensor [Rusinkiewicz 2004, section 2.3], the same scheme once more. With 1
/// and 2 for direction1 and direction2 a row is C_111, C_112, C_122, C_222 (1/cm^2), where C_ijk is the derivative of
/// tensor entry ij along k and symmetric in all of them: along a tangent w = (u, v) the curvature of direction w
/// changes by C_111 u^3 + 3 C_112 u^2 v + 3 C_122 u v^2 + C_222 v^3.
/// @throws Error if `curvatures` belong to another number of vertices.
CurvatureDerivatives ComputeCurvatureDerivatives(const TriangleMesh& mesh, const PrincipalCurvatures& curvatures);

/// Both at once, which is faster: ComputePrincipalCurvatures and ComputeCurvatureDerivatives.
struct SurfaceCurvature {
  PrincipalCurvatures principal;
  CurvatureDerivatives derivatives;
};
SurfaceCurvature ComputeSurfaceCurvature(const TriangleMesh& mesh);

}  // namespace daumier::geometry
