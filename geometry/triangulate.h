#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// mirror[v] is the vertex nearest to the reflection (-x, y, z) of vertex v.
/// @throws Error if a reflection is farther than `tolerance` cm from every vertex, or if mirror[mirror[v]] != v for
/// some v.
std::vector<int> FindMirror(const Points& points, double tolerance);

/// Cuts every polygon into a fan from one of its corners, keeping the winding. A quad is cut along its shorter diagonal
/// (if they are equal, along that of the highest corner); a polygon of more corners fans out from its highest corner.
/// With a `mirror` map the polygon whose centre has x > 0 decides, and its mirror image is cut in the mirrored way: the
/// triangulation is exactly symmetric, except in polygons that are their own mirror image.
/// @throws Error if the mirror image of a polygon is not a polygon of the mesh.
Triangles Triangulate(const PolygonMesh& mesh, const std::vector<int>& mirror = {});

/// The mesh with the triangles of Triangulate; UV follows the corners. @throws Error as Triangulate and CheckUv.
TriangleMesh TriangulateMesh(const PolygonMesh& mesh, const std::vector<int>& mirror = {});

}  // namespace daumier::geometry
