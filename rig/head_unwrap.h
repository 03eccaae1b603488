#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::rig {

/// UV of a head without overlaps: a seam runs from the back of its longest border, the neck's, along edges to the crown,
/// and what is between is laid flat as a harmonic map onto a rounded square with the crown in the middle of its top
/// [Tutte 1963]: with positive weights (cotangents, raised to kMinCotangent) and a strictly convex border no triangle
/// folds over. The weights of triangles are changed step by step until their areas are about proportional to
/// `density` (F, positive) times those of the surface; other borders (eyes, mouth) are bridged.
/// Returns the mesh with one row of UV a vertex, two at the seam; all triangles counter-clockwise, within [0, 1].
/// @throws Error if the surface has no border, is not connected or not manifold, has a triangle without area, or if a
/// triangle folds over nevertheless.
geometry::TriangleMesh UnwrapHead(const geometry::TriangleMesh& head, const Eigen::VectorXd& density);

/// What of a face a picture should show well: 1 far away, up to 6 at the middle of its landmarks. F values.
Eigen::VectorXd FaceDensity(const geometry::TriangleMesh& head, const geometry::Points& landmarks);

}  // namespace daumier::rig
