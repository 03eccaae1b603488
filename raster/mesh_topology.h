#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace daumier::raster {

/// An edge with one triangle or two. `corner` is the vertex of `triangle` that is not on the edge. Both are -1 where
/// there is no second triangle: the border of an open surface.
struct MeshEdge {
  int first = 0, second = 0;  ///< Vertices, first < second.
  std::array<int, 2> triangle = {-1, -1};
  std::array<int, 2> corner = {-1, -1};
};

/// What stays the same while the vertices of a mesh move; made once a mesh.
struct MeshTopology {
  int num_vertices = 0;
  std::vector<std::array<int, 3>> triangles;  ///< Counter-clockwise seen from outside.
  std::vector<MeshEdge> edges;                ///< Ascending by (first, second).

  int num_triangles() const { return static_cast<int>(triangles.size()); }
};

/// corners: T x 3, row a triangle. An edge with n > 2 triangles appears n - 1 times, each time with two neighbours in
/// the order of their rows. Vertices that lie at the same place but have different numbers bound different edges.
/// @throws Error if the size of `corners` is no multiple of 3 or a vertex is out of range. A triangle with a repeated
/// vertex has no area: it is kept, and has no edges.
MeshTopology MakeTopology(std::span<const int> corners, int num_vertices);

}  // namespace daumier::raster
