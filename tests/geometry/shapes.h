#pragma once
#include "geometry/mesh.h"

#include <cmath>
#include <map>
#include <numbers>

/// Meshes whose geometry is known in closed form.
namespace daumier::testing {

using geometry::Points;
using geometry::TriangleMesh;
using geometry::Vector3;

/// A coordinate (0, 1, 2) of the middle of a triangle. (Reductions of vertices(triangle, axis) are wrong in Eigen 3.4: they take
/// the first corner three times.)
template <class Triangle>
double MiddleOf(const TriangleMesh& mesh, const Triangle& triangle, int axis) {
  return (mesh.vertices(triangle[0], axis) + mesh.vertices(triangle[1], axis) + mesh.vertices(triangle[2], axis)) / 3;
}

/// One equilateral triangle of side 1 in the plane z = 0.
inline TriangleMesh EquilateralTriangle() {
  TriangleMesh mesh{Points(3, 3), geometry::Triangles(1, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0;
  mesh.triangles << 0, 1, 2;
  return mesh;
}

/// (n + 1)^2 vertices over the unit square, row by row, `height(x, y)` above it.
template <class Height>
TriangleMesh Sheet(int n, Height&& height) {
  TriangleMesh mesh{Points((n + 1) * (n + 1), 3), geometry::Triangles(2 * n * n, 3)};
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      mesh.vertices.row(j * (n + 1) + i) << x, y, height(x, y);
    }
  }
  for (int j = 0, f = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.triangles.row(f++) << v, v + 1, v + n + 2;
      mesh.triangles.row(f++) << v, v + n + 2, v + n + 1;
    }
  }
  return mesh;
}
inline TriangleMesh FlatSheet(int n) {
  return Sheet(n, [](double, double) { return 0.0; });
}

/// An octahedron cut `depth` times into four and blown up onto a sphere about the origin.
inline TriangleMesh Sphere(double radius, int depth) {
  std::vector<Vector3> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Eigen::Vector3i> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < depth; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) points.push_back((points[a] + points[b]).normalized());
      return entry->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const auto& t : triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    triangles = finer;
  }
  TriangleMesh mesh{Points(points.size(), 3), geometry::Triangles(triangles.size(), 3)};
  for (size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = radius * points[v];
  for (size_t f = 0; f < triangles.size(); ++f) mesh.triangles.row(f) = triangles[f];
  return mesh;
}

/// `around` x `across` vertices; vertex (i, j) is i * across + j, and j = 0 lies on the outer equator.
inline TriangleMesh Torus(double major, double minor, int around, int across) {
  TriangleMesh mesh{Points(around * across, 3), geometry::Triangles(2 * around * across, 3)};
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0, f = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double radius = major + minor * std::cos(b);
      mesh.vertices.row(at(i, j)) << radius * std::cos(a), radius * std::sin(a), minor * std::sin(b);
      mesh.triangles.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.triangles.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return mesh;
}

}  // namespace daumier::testing
