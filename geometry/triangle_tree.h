#pragma once
#include "geometry/nearest.h"

#include <Eigen/Geometry>

#include <vector>

namespace daumier::geometry {

/// A tree of axis-aligned boxes over the triangles of a mesh, each box halved at the median of the triangles' centres
/// along its longest side. Keeps its own copy of the mesh. Const queries are thread-safe.
class TriangleTree {
 public:
  /// @throws Error if there is no triangle, a corner is no vertex, or a position is not finite.
  explicit TriangleTree(TriangleMesh mesh);

  /// What ClosestPointOnMesh finds, in time that grows with the logarithm of the number of triangles.
  SurfacePoint Closest(const Vector3& point) const;

  /// The triangles whose bounding boxes have a point in common with `box`, ascending.
  std::vector<int> Overlapping(const Eigen::AlignedBox3d& box) const;

  const TriangleMesh& mesh() const { return mesh_; }

 private:
  /// Triangles order_[begin] .. order_[end - 1]. Its first child follows it; a leaf has no second one.
  struct Node {
    Eigen::AlignedBox3d box;
    int begin, end;
    int second_child = 0;
  };
  int Build(int begin, int end, const std::vector<Eigen::AlignedBox3d>& boxes);

  TriangleMesh mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// The bounding box of a triangle.
Eigen::AlignedBox3d TriangleBox(const TriangleMesh& mesh, int triangle);

}  // namespace daumier::geometry
