#pragma once
#include "geometry/topology.h"

namespace daumier::geometry {

/// V: 2 pi minus the angles around a vertex; on a boundary pi minus them, which is how far the boundary turns there.
/// Their sum is 2 pi times the Euler characteristic (Gauss-Bonnet). 0 at vertices without a triangle.
Eigen::VectorXd AngleDefects(const TriangleMesh& mesh);

/// V, 1/cm^2: angle defect / vertex area [Meyer et al. 2003]; 0 on boundaries, whose turning is no curvature of the
/// surface.
Eigen::VectorXd GaussianCurvature(const TriangleMesh& mesh);

/// Replaces `rounds` times each value by the area-weighted mean over its vertex and the vertices one edge away.
/// Constants are unchanged; the range of the values never grows. @throws Error if a size disagrees.
Eigen::VectorXd SmoothOverRings(const Eigen::VectorXd& values, const Eigen::VectorXd& vertex_areas,
                                const Adjacency& neighbours, int rounds);

}  // namespace daumier::geometry
