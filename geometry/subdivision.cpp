#include "geometry/subdivision.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <unordered_map>

namespace daumier::geometry {

Subdivision SubdivideOnce(const Triangles& triangles, int num_vertices) {
  Subdivision subdivision;
  subdivision.triangles.resize(4 * triangles.rows(), 3);
  std::unordered_map<int64_t, int> middles;
  const auto middle = [&](int a, int b) {
    const int64_t key = int64_t(std::min(a, b)) * num_vertices + std::max(a, b);
    const auto [found, is_new] = middles.try_emplace(key, num_vertices + int(subdivision.edges.size()));
    if (is_new) subdivision.edges.push_back({std::min(a, b), std::max(a, b)});
    return found->second;
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    DAUMIER_CHECK(std::min({a, b, c}) >= 0 && std::max({a, b, c}) < num_vertices,
                  "triangle {} has the corners {}, {}, {} of {} vertices", t, a, b, c, num_vertices);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    subdivision.triangles.row(4 * t) << a, ab, ca;
    subdivision.triangles.row(4 * t + 1) << b, bc, ab;
    subdivision.triangles.row(4 * t + 2) << c, ca, bc;
    subdivision.triangles.row(4 * t + 3) << ab, bc, ca;
  }
  return subdivision;
}

Subdivider::Subdivider(const Triangles& triangles, int num_vertices, int times)
    : triangles_(triangles), num_old_vertices_(num_vertices), num_vertices_(num_vertices) {
  for (int i = 0; i < times; ++i) {
    Subdivision once = SubdivideOnce(triangles_, num_vertices_);
    triangles_ = std::move(once.triangles);
    num_vertices_ += int(once.edges.size());
    edges_.push_back(std::move(once.edges));
  }
}

template <class Rows>
Rows Subdivider::Refine(const Rows& rows) const {
  DAUMIER_CHECK(rows.rows() == num_old_vertices_, "vertices are {}, expected {}", rows.rows(), num_old_vertices_);
  Rows all(num_vertices_, rows.cols());
  all.topRows(num_old_vertices_) = rows;
  Eigen::Index next = num_old_vertices_;
  for (const auto& edges : edges_)
    for (const auto& [a, b] : edges) all.row(next++) = 0.5 * (all.row(a) + all.row(b));
  return all;
}

Points Subdivider::Apply(const Points& vertices) const {
  return Refine(vertices);
}

TextureCoordinates Subdivider::ApplyToUv(const TextureCoordinates& uv) const {
  return Refine(uv);
}

TriangleMesh Subdivide(const TriangleMesh& mesh, int times) {
  CheckUv(mesh);
  const Subdivider surface(mesh.triangles, static_cast<int>(mesh.vertices.rows()), times);
  TriangleMesh fine{surface.Apply(mesh.vertices), surface.triangles()};
  if (!mesh.has_uv()) return fine;
  // Both subdivisions split the triangles row by row in the same order, so their rows stay parallel.
  const Subdivider texture(mesh.uv_triangles, static_cast<int>(mesh.uv.rows()), times);
  fine.uv = texture.ApplyToUv(mesh.uv);
  fine.uv_triangles = texture.triangles();
  return fine;
}

}  // namespace daumier::geometry
