#pragma once
#include "geometry/mesh.h"

#include <span>
#include <vector>

namespace daumier::geometry {

/// For each of n items a list of integers, flat: those of item i are values[offsets[i]] .. values[offsets[i + 1] - 1].
struct Adjacency {
  std::vector<int> offsets = {0};
  std::vector<int> values;

  int size() const { return static_cast<int>(offsets.size()) - 1; }
  std::span<const int> operator[](int item) const {
    return std::span(values).subspan(offsets[item], offsets[item + 1] - offsets[item]);
  }
};

/// The vertices that share an edge with each vertex, ascending; a triangle's corner out of range throws Error.
Adjacency VertexNeighbours(const Triangles& triangles, int num_vertices);
/// The triangles around each vertex, ascending; a corner out of range throws Error.
Adjacency TrianglesAtVertices(const Triangles& triangles, int num_vertices);

/// @throws Error naming the first offender: a corner out of range or repeated, an edge with more than two triangles or
/// with two that run along it in the same direction, a vertex at which two separate fans of triangles meet.
void CheckManifold(const Triangles& triangles, int num_vertices);

/// The holes of a surface, each an ordered loop of vertices with the surface on the left of the direction of walking,
/// starting at its lowest vertex index; longest loop first, then by first vertex. @throws Error as CheckManifold.
std::vector<std::vector<int>> BoundaryLoops(const Triangles& triangles, int num_vertices);

/// Vertices that are at most `rings` edges away from a seed, the seeds among them, ascending. @throws Error on a seed
/// out of range.
std::vector<int> VerticesWithin(const Adjacency& neighbours, const std::vector<int>& seeds, int rings);

/// Number of edges to the nearest seed for each vertex, -1 where no seed can be reached. @throws Error on a seed out of
/// range.
std::vector<int> RingsFrom(const Adjacency& neighbours, const std::vector<int>& seeds);

/// A label for each vertex, the same for connected vertices: 0, 1, ... in order of the lowest vertex.
std::vector<int> ConnectedComponents(const Adjacency& neighbours);

/// V - E + F over the vertices that triangles use: 2 for a sphere, 1 less for each hole.
int EulerCharacteristic(const Triangles& triangles);

}  // namespace daumier::geometry
