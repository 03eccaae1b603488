#include "raster/vertex_normals.h"

#include "raster/lanes.h"

#include <algorithm>
#include <cmath>

namespace daumier::raster {
namespace {

/// x, y, z, 0.
template <class T>
inline __attribute__((always_inline)) void LoadPoint(const T* from, Lanes<T>& to) {
  to = Lanes<T>{from[0], from[1], from[2], T(0)};
}

template <class T>
inline __attribute__((always_inline)) void CrossProduct(const Lanes<T>& a, const Lanes<T>& b, Lanes<T>& cross) {
  cross = Lanes<T>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], T(0)};
}

/// The unit vector and, in the fourth lane, 1 / length; 0 if the length is.
template <class T>
inline __attribute__((always_inline)) void NormaliseLanes(Lanes<T>& v) {
  const T square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const T inverse = square > 0 ? 1 / std::sqrt(square) : T(0);
  v *= inverse;
  v[3] = inverse;
}

/// The gradient by a vector, given that by its direction: (g - n (n . g)) / length.
template <class T>
inline __attribute__((always_inline)) void DirectionBackward(const Lanes<T>& direction, Lanes<T>& g) {
  const T along = direction[0] * g[0] + direction[1] * g[1] + direction[2] * g[2];
  g = (g - direction * along) * direction[3];
}

}  // namespace

template <class T>
void VertexNormals(const MeshTopology& topology, const T* vertices, NormalMemory<T>& memory, T* normals) {
  memory.triangle_normals.resize(topology.triangles.size());
  memory.vertex_normals.assign(topology.num_vertices, {});
  T* const sums = memory.vertex_normals.data()->data();
  for (size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& corners = topology.triangles[t];
    Lanes<T> p0, p1, p2, normal;
    LoadPoint(vertices + 3 * int64_t(corners[0]), p0);
    LoadPoint(vertices + 3 * int64_t(corners[1]), p1);
    LoadPoint(vertices + 3 * int64_t(corners[2]), p2);
    CrossProduct<T>(p1 - p0, p2 - p0, normal);
    NormaliseLanes<T>(normal);
    StoreLanes<T>(memory.triangle_normals[t].data(), normal);
    for (const int corner : corners) {
      Lanes<T> sum;
      LoadLanes(sums + 4 * int64_t(corner), sum);
      StoreLanes<T>(sums + 4 * int64_t(corner), sum + normal);
    }
  }
  for (int64_t v = 0; v < topology.num_vertices; ++v) {
    Lanes<T> sum;
    LoadLanes(sums + 4 * v, sum);
    NormaliseLanes<T>(sum);
    StoreLanes<T>(sums + 4 * v, sum);
    for (int k = 0; k < 3; ++k) normals[3 * v + k] = sum[k];
  }
}

template <class T>
void VertexNormalsBackward(const MeshTopology& topology, const T* vertices, NormalMemory<T>& memory,
                           const T* normal_gradient, T* vertex_gradient) {
  memory.gradients.resize(topology.num_vertices);
  T* const by_sum = memory.gradients.data()->data();
  for (int64_t v = 0; v < topology.num_vertices; ++v) {
    Lanes<T> g, direction;
    LoadPoint(normal_gradient + 3 * v, g);
    LoadLanes(memory.vertex_normals[v].data(), direction);
    DirectionBackward<T>(direction, g);
    g[3] = g[0] != 0 || g[1] != 0 || g[2] != 0 ? T(1) : T(0);
    StoreLanes<T>(by_sum + 4 * v, g);
  }
  for (size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& corners = topology.triangles[t];
    Lanes<T> g0, g1, g2;
    LoadLanes(by_sum + 4 * int64_t(corners[0]), g0);
    LoadLanes(by_sum + 4 * int64_t(corners[1]), g1);
    LoadLanes(by_sum + 4 * int64_t(corners[2]), g2);
    Lanes<T> g = g0 + g1 + g2;
    if (g[3] == 0) continue;  // No gradient at any corner.
    Lanes<T> p0, p1, p2, direction, by_first, by_second;
    LoadLanes(memory.triangle_normals[t].data(), direction);
    DirectionBackward<T>(direction, g);
    LoadPoint(vertices + 3 * int64_t(corners[0]), p0);
    LoadPoint(vertices + 3 * int64_t(corners[1]), p1);
    LoadPoint(vertices + 3 * int64_t(corners[2]), p2);
    CrossProduct<T>(p2 - p0, g, by_first);
    CrossProduct<T>(g, p1 - p0, by_second);
    for (int k = 0; k < 3; ++k) {
      vertex_gradient[3 * int64_t(corners[0]) + k] -= by_first[k] + by_second[k];
      vertex_gradient[3 * int64_t(corners[1]) + k] += by_first[k];
      vertex_gradient[3 * int64_t(corners[2]) + k] += by_second[k];
    }
  }
}

template void VertexNormals(const MeshTopology&, const float*, NormalMemory<float>&, float*);
template void VertexNormals(const MeshTopology&, const double*, NormalMemory<double>&, double*);
template void VertexNormalsBackward(const MeshTopology&, const float*, NormalMemory<float>&, const float*, float*);
template void VertexNormalsBackward(const MeshTopology&, const double*, NormalMemory<double>&, const double*, double*);

}  // namespace daumier::raster
