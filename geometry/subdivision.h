#pragma once
#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace daumier::geometry {

/// Each triangle in four by the middles of its edges, as in [Loop 1987] but without moving vertices. The old vertices
/// come first, then a new one in the middle of each edge. A closed surface without handles of V vertices gets 4V - 6.
struct Subdivision {
  std::vector<std::array<int, 2>> edges;  ///< Of new vertex i, the old ones that it lies between, ascending.
  Triangles triangles;                    ///< Corner triangles of each old one, then its middle; same orientation.
};
/// @throws Error if a triangle has a negative corner.
Subdivision SubdivideOnce(const Triangles& triangles, int num_vertices);

/// `times` subdivisions of a surface, of whatever positions its vertices take.
class Subdivider {
 public:
  Subdivider(const Triangles& triangles, int num_vertices, int times);

  const Triangles& triangles() const { return triangles_; }
  int num_vertices() const { return num_vertices_; }
  /// V x 3 -> num_vertices() x 3, the old vertices first. @throws Error if the number of vertices differs.
  Points Apply(const Points& vertices) const;
  /// The same for a surface in texture space, T x 2.
  TextureCoordinates ApplyToUv(const TextureCoordinates& uv) const;

 private:
  template <class Rows>
  Rows Refine(const Rows& rows) const;

  Triangles triangles_;
  int num_old_vertices_, num_vertices_;
  std::vector<std::vector<std::array<int, 2>>> edges_;  ///< Of each subdivision.
};

/// The mesh subdivided `times` times; UV is subdivided like positions, so that it stays linear along each old edge and
/// seams stay seams. @throws Error as SubdivideOnce and CheckUv.
TriangleMesh Subdivide(const TriangleMesh& mesh, int times);

}  // namespace daumier::geometry
