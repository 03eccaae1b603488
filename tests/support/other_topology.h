#pragma once
#include "core/random.h"
#include "geometry/mesh.h"
#include "geometry/subdivision.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

/// The same surface with other vertices, of which it is known where they come from.
namespace daumier::testing {

struct OtherTopology {
  geometry::Triangles triangles;
  std::vector<std::pair<int, int>> sources;  ///< Each vertex lies in the middle between two of the old ones, or on one.

  geometry::Points Vertices(const geometry::Points& old) const {
    geometry::Points points(std::ssize(sources), 3);
    for (size_t v = 0; v < sources.size(); ++v)
      points.row(Eigen::Index(v)) = 0.5 * (old.row(sources[v].first) + old.row(sources[v].second));
    return points;
  }
};

/// Each triangle in four.
inline OtherTopology SubdividedTopology(const geometry::Triangles& triangles, int num_vertices) {
  const geometry::Subdivision subdivision = geometry::SubdivideOnce(triangles, num_vertices);
  OtherTopology other{subdivision.triangles, {}};
  for (int v = 0; v < num_vertices; ++v) other.sources.emplace_back(v, v);
  for (const auto& [a, b] : subdivision.edges) other.sources.emplace_back(a, b);
  return other;
}

/// Vertices and triangles in random order; every triangle of a random third has corners of its own, as along seams.
inline OtherTopology ShuffledTopology(const geometry::Triangles& triangles, int num_vertices, Rng& rng) {
  OtherTopology other;
  const std::vector<int> order = rng.Permutation(num_vertices), rows = rng.Permutation(int(triangles.rows()));
  std::vector<int> place(static_cast<size_t>(num_vertices));
  for (int v = 0; v < num_vertices; ++v) {
    place[size_t(order[size_t(v)])] = v;
    other.sources.emplace_back(order[size_t(v)], order[size_t(v)]);
  }
  other.triangles.resize(triangles.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const bool is_split = rng.Below(3) == 0;
    for (int k = 0; k < 3; ++k) {
      const int old = triangles(rows[size_t(f)], k);
      other.triangles(f, k) = is_split ? int(other.sources.size()) : place[size_t(old)];
      if (is_split) other.sources.emplace_back(old, old);
    }
  }
  return other;
}

/// Fewer vertices, about `share` of them: inner vertices are moved onto a neighbour, in random order, where that folds no
/// triangle over and leaves the surface manifold. Borders stay.
inline OtherTopology DecimatedTopology(const geometry::TriangleMesh& mesh, double share, Rng& rng) {
  const int num_vertices = int(mesh.vertices.rows());
  std::vector<std::vector<int>> rows(static_cast<size_t>(num_vertices));
  geometry::Triangles triangles = mesh.triangles;
  std::vector<bool> is_gone(size_t(triangles.rows()), false), is_removed(static_cast<size_t>(num_vertices), false);
  for (int f = 0; f < triangles.rows(); ++f)
    for (const int v : triangles.row(f)) rows[size_t(v)].push_back(f);
  std::vector<bool> is_border(static_cast<size_t>(num_vertices), false);
  for (const auto& loop : geometry::BoundaryLoops(mesh.triangles, num_vertices))
    for (const int v : loop) is_border[size_t(v)] = true;
  const auto around = [&](int v) {
    std::vector<int> ring;
    for (const int f : rows[size_t(v)])
      for (const int u : triangles.row(f))
        if (u != v) ring.push_back(u);
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  };
  const auto normal = [&](int f, int from, int to) {
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k)
      p[size_t(k)] = mesh.vertices.row(triangles(f, k) == from ? to : triangles(f, k)).transpose();
    return Eigen::Vector3d((p[1] - p[0]).cross(p[2] - p[0]).normalized());
  };
  int num_left = num_vertices;
  for (int round = 0; round < 20 && num_left > share * num_vertices; ++round) {
    for (const int v : rng.Permutation(num_vertices)) {
      if (num_left <= share * num_vertices) break;
      if (is_removed[size_t(v)] || is_border[size_t(v)]) continue;
      const std::vector<int> ring = around(v);
      int best = -1;
      double least = std::numeric_limits<double>::infinity();
      for (const int u : ring) {
        const std::vector<int> other = around(u);
        std::vector<int> common;
        std::set_intersection(ring.begin(), ring.end(), other.begin(), other.end(), std::back_inserter(common));
        const bool folds = std::ranges::any_of(rows[size_t(v)], [&](int f) {
          const auto corners = triangles.row(f);
          if (std::ranges::find(corners, u) != corners.end()) return false;
          return normal(f, v, u).dot(normal(f, v, v)) < 0.7;
        });
        const double length = (mesh.vertices.row(u) - mesh.vertices.row(v)).norm();
        if (common.size() != 2 || folds || length >= least) continue;
        least = length;
        best = u;
      }
      if (best < 0) continue;
      for (const int f : rows[size_t(v)]) {
        const auto corners = triangles.row(f);
        if (std::ranges::find(corners, best) != corners.end()) {
          is_gone[size_t(f)] = true;
          for (const int u : corners)
            if (u != v) std::erase(rows[size_t(u)], f);
        } else {
          for (int k = 0; k < 3; ++k)
            if (triangles(f, k) == v) triangles(f, k) = best;
          rows[size_t(best)].push_back(f);
        }
      }
      rows[size_t(v)].clear();
      is_removed[size_t(v)] = true;
      --num_left;
    }
  }
  OtherTopology other;
  std::vector<int> place(static_cast<size_t>(num_vertices), -1);
  for (int v = 0; v < num_vertices; ++v) {
    if (is_removed[size_t(v)]) continue;
    place[size_t(v)] = int(other.sources.size());
    other.sources.emplace_back(v, v);
  }
  std::vector<int> kept;
  for (int f = 0; f < triangles.rows(); ++f)
    if (!is_gone[size_t(f)]) kept.push_back(f);
  other.triangles = triangles(kept, Eigen::all).unaryExpr([&](int v) { return place[size_t(v)]; });
  return other;
}

}  // namespace daumier::testing
