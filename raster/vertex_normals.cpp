#include "raster/vertex_normals.h"

#include "raster/lanes.h"

#include <algorithm>
#include <cmath>

namespace daumier::raster {
namespace {

/// Corners of four triangles; beyond the last one it is repeated, and `count` is less than 4.
struct FourTriangles {
  FourTriangles(const MeshTopology& topology, size_t first)
      : count(std::min<size_t>(4, topology.triangles.size() - first)) {
    for (size_t k = 0; k < 4; ++k) {
      const auto& corners = topology.triangles[first + std::min(k, count - 1)];
      for (int j = 0; j < 3; ++j) rows[j][k] = corners[j];
    }
  }
  int64_t rows[3][4];
  size_t count;
};

template <class T>
void CopyPoints(int64_t count, const T* from, std::vector<std::array<T, 4>>& to) {
  to.resize(count);
  for (int64_t i = 0; i < count; ++i) to[i] = {from[3 * i], from[3 * i + 1], from[3 * i + 2], T(0)};
}

/// a x b of four pairs, by coordinate.
template <class T>
inline __attribute__((always_inline)) void CrossProducts(const Lanes<T> (&a)[4], const Lanes<T> (&b)[4],
                                                         Lanes<T> (&cross)[4]) {
  cross[0] = a[1] * b[2] - a[2] * b[1];
  cross[1] = a[2] * b[0] - a[0] * b[2];
  cross[2] = a[0] * b[1] - a[1] * b[0];
  cross[3] = Lanes<T>{};
}

/// Two edges of four triangles, by coordinate.
template <class T>
struct FourEdgePairs {
  FourEdgePairs(const std::vector<std::array<T, 4>>& vertices, const FourTriangles& four) {
    Lanes<T> p0[4];
    GatherRecords(vertices[0].data(), 4, four.rows[0], p0);
    GatherRecords(vertices[0].data(), 4, four.rows[1], first);
    GatherRecords(vertices[0].data(), 4, four.rows[2], second);
    for (int k = 0; k < 4; ++k) first[k] -= p0[k], second[k] -= p0[k];
  }
  Lanes<T> first[4], second[4];
};

/// Unit vectors and, in the fourth place, 1 / length; 0 if the length is.
template <class T>
inline __attribute__((always_inline)) void NormaliseFour(Lanes<T> (&v)[4]) {
  const Lanes<T> square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  Lanes<T> length;
  for (int k = 0; k < 4; ++k) length[k] = std::sqrt(square[k]);
  v[3] = square > 0 ? 1 / length : Lanes<T>{};
  for (int k = 0; k < 3; ++k) v[k] *= v[3];
}

/// Gradients by vectors, given those by their directions: (g - n (n . g)) / length.
template <class T>
inline __attribute__((always_inline)) void DirectionsBackward(const Lanes<T> (&direction)[4], Lanes<T> (&g)[4]) {
  const Lanes<T> along = direction[0] * g[0] + direction[1] * g[1] + direction[2] * g[2];
  for (int k = 0; k < 3; ++k) g[k] = (g[k] - direction[k] * along) * direction[3];
}

}  // namespace

template <class T>
void VertexNormals(const MeshTopology& topology, const T* vertices, NormalMemory<T>& memory, T* normals) {
  const size_t num_triangles = topology.triangles.size(), num_vertices = size_t(topology.num_vertices);
  memory.triangle_normals.resize((num_triangles + 3) / 4 * 4);
  memory.vertex_normals.assign((num_vertices + 3) / 4 * 4, {});
  CopyPoints(int64_t(num_vertices), vertices, memory.vertices);
  for (size_t t = 0; t < num_triangles; t += 4) {
    const FourTriangles four(topology, t);
    const FourEdgePairs<T> edges(memory.vertices, four);
    Lanes<T> normal[4];
    CrossProducts<T>(edges.first, edges.second, normal);
    NormaliseFour<T>(normal);
    Transpose<T>(normal[0], normal[1], normal[2], normal[3]);
    for (size_t k = 0; k < 4; ++k) StoreLanes<T>(memory.triangle_normals[t + k].data(), normal[k]);
    for (size_t k = 0; k < four.count; ++k) {
      for (int j = 0; j < 3; ++j) AddLanes<T>(memory.vertex_normals[four.rows[j][k]].data(), T(1), normal[k]);
    }
  }
  for (size_t v = 0; v < num_vertices; v += 4) {
    Lanes<T> sum[4];
    const int64_t rows[4] = {0, 1, 2, 3};
    GatherRecords(memory.vertex_normals[v].data(), 4, rows, sum);
    NormaliseFour<T>(sum);
    Transpose<T>(sum[0], sum[1], sum[2], sum[3]);
    for (size_t k = 0; k < 4; ++k) StoreLanes<T>(memory.vertex_normals[v + k].data(), sum[k]);
  }
  for (size_t v = 0; v < num_vertices; ++v) {
    for (int k = 0; k < 3; ++k) normals[3 * v + k] = memory.vertex_normals[v][k];
  }
}

template <class T>
void VertexNormalsBackward(const MeshTopology& topology, NormalMemory<T>& memory, const T* normal_gradient,
                           T* vertex_gradient) {
  const size_t num_triangles = topology.triangles.size(), num_vertices = size_t(topology.num_vertices);
  CopyPoints(int64_t(num_vertices), normal_gradient, memory.gradients);
  memory.gradients.resize((num_vertices + 3) / 4 * 4);
  for (size_t v = 0; v < num_vertices; v += 4) {
    Lanes<T> g[4], direction[4];
    const int64_t rows[4] = {0, 1, 2, 3};
    GatherRecords(memory.gradients[v].data(), 4, rows, g);
    GatherRecords(memory.vertex_normals[v].data(), 4, rows, direction);
    DirectionsBackward<T>(direction, g);
    Transpose<T>(g[0], g[1], g[2], g[3]);
    for (size_t k = 0; k < 4; ++k) StoreLanes<T>(memory.gradients[v + k].data(), g[k]);
  }
  memory.vertex_gradients.assign(num_vertices, {});
  for (size_t t = 0; t < num_triangles; t += 4) {
    const FourTriangles four(topology, t);
    Lanes<T> g[4] = {}, direction[4];
    for (int j = 0; j < 3; ++j) {
      Lanes<T> at_corner[4];
      GatherRecords(memory.gradients[0].data(), 4, four.rows[j], at_corner);
      for (int k = 0; k < 3; ++k) g[k] += at_corner[k];
    }
    const int64_t rows[4] = {0, 1, 2, 3};
    GatherRecords(memory.triangle_normals[t].data(), 4, rows, direction);
    DirectionsBackward<T>(direction, g);
    const FourEdgePairs<T> edges(memory.vertices, four);
    Lanes<T> by_first[4], by_second[4];
    CrossProducts<T>(edges.second, g, by_first);
    CrossProducts<T>(g, edges.first, by_second);
    Transpose<T>(by_first[0], by_first[1], by_first[2], by_first[3]);
    Transpose<T>(by_second[0], by_second[1], by_second[2], by_second[3]);
    for (size_t k = 0; k < four.count; ++k) {
      AddLanes<T>(memory.vertex_gradients[four.rows[0][k]].data(), T(-1), by_first[k] + by_second[k]);
      AddLanes<T>(memory.vertex_gradients[four.rows[1][k]].data(), T(1), by_first[k]);
      AddLanes<T>(memory.vertex_gradients[four.rows[2][k]].data(), T(1), by_second[k]);
    }
  }
  for (size_t v = 0; v < num_vertices; ++v) {
    for (int k = 0; k < 3; ++k) vertex_gradient[3 * v + k] += memory.vertex_gradients[v][k];
  }
}

template void VertexNormals(const MeshTopology&, const float*, NormalMemory<float>&, float*);
template void VertexNormals(const MeshTopology&, const double*, NormalMemory<double>&, double*);
template void VertexNormalsBackward(const MeshTopology&, NormalMemory<float>&, const float*, float*);
template void VertexNormalsBackward(const MeshTopology&, NormalMemory<double>&, const double*, double*);

}  // namespace daumier::raster
