#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::geometry {

/// Eigenfunctions of the Laplace-Beltrami operator of a surface (free at its borders), smoothest first, without the
/// constant: L f = lambda A f, L the cotangent Laplacian and A the vertices' areas on the diagonal.
struct SmoothestFunctions {
  Eigen::VectorXd values;  ///< K: lambda, 1/cm^2, ascending; above 0 if the surface is connected.
  Eigen::MatrixXd
      functions;  ///< V x K, F^T A F = sum(A) I: root mean square 1 over the area. A greatest |value| is positive.
};

/// By Lanczos iterations on the inverse of L + shift A [Sorensen 1992]. Vertices without a triangle are 0 in all functions.
/// @throws Error unless 0 < count < V, if a triangle has no area, or if the iteration does not converge.
SmoothestFunctions FindSmoothestFunctions(const TriangleMesh& mesh, int count);

}  // namespace daumier::geometry
