#include "geometry/self_intersections.h"

#include "geometry/triangle_tree.h"

#include <algorithm>

namespace daumier::geometry {
namespace {

constexpr double kTouch = 1e-12;

Eigen::Matrix3d CornerPoints(const TriangleMesh& mesh, int triangle) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = mesh.vertices.row(mesh.triangles(triangle, k));
  return corners;
}

bool ShareVertex(const Triangles& triangles, int f, int g) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (triangles(f, i) == triangles(g, j)) return true;
    }
  }
  return false;
}

}  // namespace

bool TrianglesIntersect(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  // Relative to a common point, so that far from the origin nothing is lost.
  const Eigen::RowVector3d origin = a.row(0);
  const Eigen::Matrix3d p = a.rowwise() - origin, q = b.rowwise() - origin;
  const double size = std::max(p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff());
  const auto is_separating = [&](const Vector3& axis) {
    const Vector3 on_p = p * axis, on_q = q * axis;
    const double touch = kTouch * size * axis.norm();
    return on_p.maxCoeff() <= on_q.minCoeff() + touch || on_q.maxCoeff() <= on_p.minCoeff() + touch;
  };
  const auto edge = [](const Eigen::Matrix3d& corners, int k) -> Vector3 {
    return corners.row((k + 1) % 3) - corners.row(k);
  };
  for (const Eigen::Matrix3d& corners : {p, q}) {
    if (is_separating(edge(corners, 0).cross(edge(corners, 1)))) return false;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector3 e = edge(p, i), f = edge(q, j), axis = e.cross(f);
      // Parallel edges give no direction of their own.
      if (axis.norm() > kTouch * e.norm() * f.norm() && is_separating(axis)) return false;
    }
  }
  return true;
}

std::vector<TrianglePair> SelfIntersections(const TriangleMesh& mesh) {
  const TriangleTree tree(mesh);
  std::vector<TrianglePair> pairs;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::Matrix3d corners = CornerPoints(mesh, f);
    for (const int g : tree.Overlapping(TriangleBox(mesh, f))) {
      if (g > f && !ShareVertex(mesh.triangles, f, g) && TrianglesIntersect(corners, CornerPoints(mesh, g)))
        pairs.push_back({f, g});
    }
  }
  return pairs;
}

}  // namespace daumier::geometry
