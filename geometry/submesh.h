#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// How vertices were renumbered when some were kept.
struct VertexMap {
  std::vector<int> new_from_old;  ///< -1: not kept.
  std::vector<int> old_from_new;
};

/// Numbers the kept vertices 0, 1, ... in the order of their old index. Vertices may come in any order and repeatedly.
/// @throws Error on a vertex out of range.
VertexMap MapKept(const std::vector<int>& kept, int num_vertices);

/// The new indices of those `vertices` that were kept, in the same order.
std::vector<int> SelectVertices(const std::vector<int>& vertices, const VertexMap& map);
/// The rows of the kept vertices.
Points SelectPoints(const Points& points, const VertexMap& map);
/// The triangles whose corners were all kept, renumbered, in the same order.
Triangles SelectTriangles(const Triangles& triangles, const VertexMap& map);

/// The part of a mesh between kept vertices: all of these, and the faces whose corners are all among them. UV follows
/// the corners; rows of UV that no kept face uses are removed. @throws Error as CheckUv.
TriangleMesh Submesh(const TriangleMesh& mesh, const VertexMap& map);
PolygonMesh Submesh(const PolygonMesh& mesh, const VertexMap& map);

}  // namespace daumier::geometry
