#include "geometry/nearest.h"

#include "core/error.h"

#include <cmath>
#include <limits>
#include <nanoflann.hpp>

namespace daumier::geometry {

struct VertexTree::Index {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Index>, Index, 3, int>;

  explicit Index(Points all) : points(std::move(all)), tree(3, *this) {}

  // The names are nanoflann's.
  size_t kdtree_get_point_count() const { return static_cast<size_t>(points.rows()); }
  double kdtree_get_pt(size_t i, size_t k) const { return points(i, k); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  Points points;
  Tree tree;
};

VertexTree::VertexTree(Points points) {
  DAUMIER_CHECK(points.rows() > 0, "a tree needs at least one point");
  index_ = std::make_unique<Index>(std::move(points));
  index_->tree.buildIndex();
}

VertexTree::~VertexTree() = default;
VertexTree::VertexTree(VertexTree&&) noexcept = default;
VertexTree& VertexTree::operator=(VertexTree&&) noexcept = default;

NearestVertex VertexTree::Nearest(const Vector3& point) const {
  int vertex = -1;
  double squared_distance = 0;
  index_->tree.knnSearch(point.data(), 1, &vertex, &squared_distance);
  return {vertex, std::sqrt(squared_distance)};
}

namespace {

/// Barycentric coordinates of the point of segment a-b that is nearest to p, as weights of a and b.
Eigen::Vector2d ClosestOnSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return {1 - t, t};
}

/// Barycentric coordinates of the point of a triangle (rows: corners) that is nearest to p.
Vector3 ClosestOnTriangle(const Vector3& p, const Eigen::Matrix3d& corners) {
  const Vector3 a = corners.row(0), b = corners.row(1), c = corners.row(2);
  const Vector3 normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area > 0) {
    const Vector3 inside((c - b).cross(p - b).dot(normal) / area, (a - c).cross(p - c).dot(normal) / area,
                         (b - a).cross(p - a).dot(normal) / area);
    if (inside.minCoeff() >= 0) return inside;
  }
  Vector3 best = Vector3::UnitX();
  double best_distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Eigen::Vector2d weights = ClosestOnSegment(p, corners.row(k), corners.row(next));
    Vector3 candidate = Vector3::Zero();
    candidate[k] = weights[0];
    candidate[next] = weights[1];
    const double distance = (corners.transpose() * candidate - p).squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

SurfacePoint ClosestPointOnTriangle(const TriangleMesh& mesh, int triangle, const Vector3& point) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = mesh.vertices.row(mesh.triangles(triangle, k));
  const Vector3 barycentric = ClosestOnTriangle(point, corners);
  const Vector3 position = corners.transpose() * barycentric;
  return {triangle, barycentric, position, (position - point).norm()};
}

SurfacePoint ClosestPointOnMesh(const TriangleMesh& mesh, const Vector3& point) {
  DAUMIER_CHECK(mesh.triangles.rows() > 0, "a mesh without triangles has no closest point");
  SurfacePoint best = ClosestPointOnTriangle(mesh, 0, point);
  for (int f = 1; f < mesh.triangles.rows(); ++f) {
    const SurfacePoint candidate = ClosestPointOnTriangle(mesh, f, point);
    if (candidate.distance < best.distance) best = candidate;
  }
  return best;
}

}  // namespace daumier::geometry
