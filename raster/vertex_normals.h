#pragma once
#include "raster/mesh_topology.h"

#include <array>
#include <vector>

namespace daumier::raster {

/// What the gradient of normals needs. The next call reuses its memory.
template <class T>
struct NormalMemory {
  std::vector<std::array<T, 4>> triangle_normals;  ///< Unit normal and 1 / length of the cross product; 0 without area.
  std::vector<std::array<T, 4>> vertex_normals;    ///< Unit normal and 1 / length of the sum; 0 where the sum is 0.
  std::vector<std::array<T, 4>> vertices;          ///< Copied, 16 bytes each for float.
  std::vector<std::array<T, 4>> gradients, vertex_gradients;
};

/// Vertex normals as in Deep3D's renderer [Deng et al. 2019]: cross products of the triangles, normalised, summed over
/// the triangles at each vertex, normalised. vertices: V x 3; normals: V x 3, written; 0 at a vertex without triangles
/// that have area.
template <class T>
void VertexNormals(const MeshTopology& topology, const T* vertices, NormalMemory<T>& memory, T* normals);

/// Adds to vertex_gradient (V x 3) the gradient of sum(normals * normal_gradient); `memory` is that of VertexNormals,
/// and holds the vertices.
template <class T>
void VertexNormalsBackward(const MeshTopology& topology, NormalMemory<T>& memory, const T* normal_gradient,
                           T* vertex_gradient);

}  // namespace daumier::raster
