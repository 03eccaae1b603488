#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// For each vertex the lowest vertex at its place: a vertex represents its place, unless it lies within `tolerance` cm of
/// an earlier one that does. O(V) for any points. A vertex that is not finite represents itself.
/// @throws Error if the tolerance is negative.
std::vector<int> WeldByPlace(const Points& points, double tolerance);

/// The distance below which two vertices are one place: 1e-6 of the size of the mesh, the longest side of the box that
/// holds the middle half of the coordinates of each axis. Few vertices far away do not change it.
double WeldTolerance(const Points& points);

/// The same surface with one vertex at each place, as files split vertices along seams of UV or give every triangle its
/// own: without UV, without triangles that have fewer than three places, and with the first alone of triangles between
/// the same three places. Vertices that no triangle uses are removed; the others keep their order.
TriangleMesh WeldedSurface(const TriangleMesh& mesh, double tolerance);

}  // namespace daumier::geometry
