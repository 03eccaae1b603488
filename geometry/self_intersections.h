#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// Whether two triangles (rows: corners) pierce each other, by separating axes: the two normals and the nine products
/// of their edges [Gottschalk et al. 1996]. Triangles that only touch, or that lie in one plane, do not pierce; what
/// overlaps by less than 1e-12 of the triangles' size counts as touching. A triangle without area pierces nothing.
bool TrianglesIntersect(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

struct TrianglePair {
  int first, second;  ///< first < second
  bool operator==(const TrianglePair&) const = default;
};

/// The pairs of triangles of a mesh that pierce each other and share no vertex, ascending. Neighbours that share a
/// vertex are left out, since they always touch there. @throws Error as TriangleTree.
std::vector<TrianglePair> SelfIntersections(const TriangleMesh& mesh);

}  // namespace daumier::geometry
