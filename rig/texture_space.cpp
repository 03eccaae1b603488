#include "rig/texture_space.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

constexpr double kWellInside = 1e-6;
constexpr double kOnEdge = 1e-9;  // Of a weight: texels on an edge belong to a triangle at each of its sides.

/// Twice the signed area of a triangle.
double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Calls visit(texel, weights) for each texel whose middle has weights of at least `least` in triangle t.
template <class Visit>
void ForTexelsOf(const TextureSpace& space, Eigen::Index t, int size, double least, Visit&& visit) {
  // In texels, y downwards; the middle of texel (row, column) is at (column, row).
  std::array<Eigen::Vector2d, 3> corners;
  for (int k = 0; k < 3; ++k) {
    const auto at = space.uv.row(space.uv_triangles(t, k));
    corners[size_t(k)] = {at[0] * size - 0.5, (1 - at[1]) * size - 0.5};
  }
  const auto& [a, b, c] = corners;
  const double area = Cross(a, b, c);
  if (area == 0) return;
  const auto texel_of = [&](double place) { return std::clamp(place, 0.0, size - 1.0); };
  const int left = int(std::ceil(texel_of(std::min({a.x(), b.x(), c.x()})))),
            right = int(std::floor(texel_of(std::max({a.x(), b.x(), c.x()})))),
            top = int(std::ceil(texel_of(std::min({a.y(), b.y(), c.y()})))),
            bottom = int(std::floor(texel_of(std::max({a.y(), b.y(), c.y()}))));
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const Eigen::Vector2d p(column, row);
      const Eigen::Vector3d weights(Cross(p, b, c) / area, Cross(a, p, c) / area, Cross(a, b, p) / area);
      if (weights.minCoeff() >= least) visit(row * size + column, weights);
    }
  }
}

void CheckSize(int size) {
  DAUMIER_CHECK(16 <= size && size <= 8192, "a texture of {} texels a side, expected 16 .. 8192", size);
}

}  // namespace

TexelMap TextureSpace::Rasterise(int size) const {
  CheckSize(size);
  const size_t num_texels = size_t(size) * size_t(size);
  TexelMap texels{size, std::vector<int>(num_texels, -1),
                  std::vector<Eigen::Vector3f>(num_texels, Eigen::Vector3f::Zero())};
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    ForTexelsOf(*this, t, size, -kOnEdge, [&](int texel, const Eigen::Vector3d& weights) {
      if (texels.triangles[size_t(texel)] >= 0) return;
      texels.triangles[size_t(texel)] = int(t);
      texels.weights[size_t(texel)] = (weights.cwiseMax(0) / weights.cwiseMax(0).sum()).cast<float>();
    });
  return texels;
}

int NumOverlappingTexels(const TextureSpace& space, int size) {
  CheckSize(size);
  std::vector<int> counts(size_t(size) * size_t(size), 0);
  for (Eigen::Index t = 0; t < space.triangles.rows(); ++t)
    ForTexelsOf(space, t, size, kWellInside, [&](int texel, const Eigen::Vector3d&) { ++counts[size_t(texel)]; });
  return int(std::count_if(counts.begin(), counts.end(), [](int count) { return count > 1; }));
}

std::vector<int> NearestShownTexels(const TexelMap& texels, int reach) {
  const int size = texels.size;
  std::vector<int> nearest(texels.triangles.size(), -1), front;
  for (int i = 0; i < texels.num_texels(); ++i)
    if (texels.triangles[size_t(i)] >= 0) nearest[size_t(i)] = i;
  const auto distance = [&](int i, int j) { return std::hypot(i / size - j / size, i % size - j % size); };
  // Each round moves the filled area's border by a texel; a texel takes the nearest of what its neighbours have.
  const auto for_neighbours = [&](int i, const auto& visit) {
    const int row = i / size, column = i % size;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, size - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, size - 1); ++c)
        if (r != row || c != column) visit(r * size + c);
  };
  for (int i = 0; i < texels.num_texels(); ++i)
    if (nearest[size_t(i)] >= 0) front.push_back(i);
  for (int step = 0; step < reach && !front.empty(); ++step) {
    std::vector<int> next;
    std::vector<std::pair<int, int>> found;
    for (const int i : front)
      for_neighbours(i, [&](int n) {
        if (nearest[size_t(n)] < 0) next.push_back(n);
      });
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    for (const int i : next) {
      int best = -1;
      for_neighbours(i, [&](int n) {
        const int source = nearest[size_t(n)];
        if (source >= 0 && (best < 0 || distance(i, source) < distance(i, best))) best = source;
      });
      if (distance(i, best) <= reach) found.emplace_back(i, best);
    }
    front.clear();
    for (const auto& [i, source] : found) {
      nearest[size_t(i)] = source;
      front.push_back(i);
    }
  }
  return nearest;
}

geometry::TriangleMesh JoinedMesh(const RiggedHead& head) {
  geometry::TriangleMesh joined = head.mesh;
  for (const RiggedEye& eye : head.eyes) {
    const Eigen::Index num_vertices = joined.vertices.rows(), num_triangles = joined.triangles.rows(),
                       num_uv = joined.uv.rows();
    joined.vertices.conservativeResize(num_vertices + eye.mesh.vertices.rows(), 3);
    joined.vertices.bottomRows(eye.mesh.vertices.rows()) = eye.mesh.vertices.rowwise() + eye.centre.transpose();
    joined.triangles.conservativeResize(num_triangles + eye.mesh.triangles.rows(), 3);
    joined.triangles.bottomRows(eye.mesh.triangles.rows()) = eye.mesh.triangles.array() + int(num_vertices);
    if (!joined.has_uv()) continue;
    joined.uv.conservativeResize(num_uv + eye.mesh.uv.rows(), 2);
    joined.uv.bottomRows(eye.mesh.uv.rows()) = eye.mesh.uv;
    joined.uv_triangles.conservativeResize(num_triangles + eye.mesh.uv_triangles.rows(), 3);
    joined.uv_triangles.bottomRows(eye.mesh.uv_triangles.rows()) = eye.mesh.uv_triangles.array() + int(num_uv);
  }
  return joined;
}

}  // namespace daumier::rig
