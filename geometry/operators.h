#pragma once
#include "geometry/mesh.h"

#include <Eigen/SparseCore>

#include <limits>

namespace daumier::geometry {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The least cotangent that enters the cotangent Laplacian: angles beyond 88.9 degrees count as 88.9 degrees, which
/// keeps all edge weights positive and the solution free of spikes on meshes with obtuse triangles.
inline constexpr double kMinCotangent = 0.02;
/// Clamps no cotangent: the exact finite-element Laplacian.
inline constexpr double kUnclamped = -std::numeric_limits<double>::infinity();

/// F x 3: the cotangent of the angle at each corner, raised to `min_cotangent` where it is less.
/// @throws Error naming a triangle without area.
Points CornerCotangents(const TriangleMesh& mesh, double min_cotangent = kMinCotangent);

/// V x V, symmetric positive semidefinite, rows sum to 0:
///   (L x)_i = sum_j w_ij (x_i - x_j),
///   w_ij = 1/2 sum over the triangles f at edge ij of s_f cot(angle opposite to ij),
/// with every cotangent raised to `min_cotangent`. `triangle_scales` (F, or empty for ones) are the s_f: Lx with scales
/// s is the divergence of the gradient of x scaled by s_f in each triangle, if nothing is clamped.
/// @throws Error as CornerCotangents, or if the number of scales differs.
SparseMatrix CotangentLaplacian(const TriangleMesh& mesh, double min_cotangent = kMinCotangent,
                                const Eigen::VectorXd& triangle_scales = {});

/// V x V, symmetric positive semidefinite, rows sum to 0: (L x)_i = sum over the neighbours j of i of (x_i - x_j).
SparseMatrix UniformLaplacian(const Triangles& triangles, int num_vertices);

/// 3F x V: rows 3f .. 3f + 2 give the gradient in triangle f of the piecewise linear function with these vertex values.
/// @throws Error naming a triangle without area.
SparseMatrix Gradient(const TriangleMesh& mesh);

/// V x 3F, the negative of the integrated divergence: D = G^T diag(A), A the triangles' areas, so that D G is the
/// unclamped cotangent Laplacian and min_x sum_f A_f |G x - g|^2 is where D G x = D g. @throws Error naming a triangle
/// without area.
SparseMatrix Divergence(const TriangleMesh& mesh);

}  // namespace daumier::geometry
