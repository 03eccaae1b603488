#include "geometry/surface_matcher.h"

#include "geometry/normals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace daumier::geometry {
namespace {

/// Barycentric coordinates below this are on the opposite edge.
constexpr double kOnEdge = 1e-9;

}  // namespace

SurfaceMatcher::SurfaceMatcher(TriangleMesh target)
    : tree_(std::move(target)),
      vertex_normals_(VertexNormals(tree_.mesh())),
      is_border_edge_(tree_.mesh().triangles.rows(), {false, false, false}),
      is_border_vertex_(tree_.mesh().vertices.rows(), false) {
  const Triangles& triangles = tree_.mesh().triangles;
  std::map<std::pair<int, int>, int> num_triangles;
  const auto edge = [&](int f, int k) -> std::pair<int, int> {
    return std::minmax({triangles(f, (k + 1) % 3), triangles(f, (k + 2) % 3)});
  };
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) ++num_triangles[edge(f, k)];
  }
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = edge(f, k);
      if (num_triangles.at({a, b}) == 1) is_border_edge_[f][k] = is_border_vertex_[a] = is_border_vertex_[b] = true;
    }
  }
}

bool SurfaceMatcher::IsOnBorder(const SurfacePoint& point) const {
  int num_zero = 0;
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] > kOnEdge) continue;
    ++num_zero;
    if (is_border_edge_[point.triangle][k]) return true;
  }
  if (num_zero < 2) return false;
  int corner;
  point.barycentric.maxCoeff(&corner);
  return is_border_vertex_[mesh().triangles(point.triangle, corner)];
}

std::optional<SurfacePoint> SurfaceMatcher::Match(const Vector3& point, const Vector3& normal,
                                                  const MatchLimits& limits) const {
  const SurfacePoint closest = tree_.Closest(point);
  if (closest.distance > limits.distance || IsOnBorder(closest)) return std::nullopt;
  Vector3 target_normal = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    target_normal += closest.barycentric[k] * vertex_normals_.row(mesh().triangles(closest.triangle, k)).transpose();
  const double least = std::cos(limits.angle_degrees * std::numbers::pi / 180) * target_normal.norm();
  if (normal.dot(target_normal) < least) return std::nullopt;
  return closest;
}

}  // namespace daumier::geometry
