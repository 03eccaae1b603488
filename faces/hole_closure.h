#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::faces {

/// The topology of a patch that closes a hole of a surface: rings of as many vertices as the hole's loop has, one
/// within the other, and an apex in the last ring. Its own vertices are numbered first_vertex, ...: ring by ring, then
/// the apex. Without rings it is a fan from the loop to the apex.
struct HoleClosure {
  std::vector<int> loop;  ///< As geometry::BoundaryLoops gives it: the surface is on its left.
  int first_vertex = 0;
  int num_rings = 0;

  int size() const { return static_cast<int>(loop.size()); }
  int num_vertices() const { return num_rings * size() + 1; }
  int apex() const { return first_vertex + num_rings * size(); }
  /// Vertex i of ring `ring`, 0-based; of the loop itself for -1.
  int vertex(int ring, int i) const { return ring < 0 ? loop[size_t(i)] : first_vertex + ring * size() + i; }
  /// The vertex of the loop that an own vertex hangs on; the first one for the apex.
  int LoopVertexOf(int own_vertex) const;
  /// Oriented as the surface around the hole: the strips between rings from the loop on, then the fan to the apex,
  /// 2 size() triangles a ring and size() of the fan.
  std::vector<Eigen::Vector3i> Triangles() const;
};

/// The positions of a loop, N x 3.
geometry::Points LoopPoints(const geometry::Points& vertices, const std::vector<int>& loop);

}  // namespace daumier::faces
