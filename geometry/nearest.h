#pragma once
#include "geometry/mesh.h"

#include <memory>

namespace daumier::geometry {

struct NearestVertex {
  int vertex;
  double distance;  ///< cm
};

/// KD-tree over points; finds the exact nearest one. Keeps its own copy of the points.
class VertexTree {
 public:
  /// @throws Error if there is no point.
  explicit VertexTree(Points points);
  ~VertexTree();
  VertexTree(VertexTree&&) noexcept;
  VertexTree& operator=(VertexTree&&) noexcept;

  NearestVertex Nearest(const Vector3& point) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

/// A point on a surface: sum_k barycentric[k] * corner k of `triangle`.
struct SurfacePoint {
  int triangle;
  Vector3 barycentric;
  Vector3 position;
  double distance;  ///< From the query point, cm.
};

/// The point of one triangle that is nearest to `point`.
SurfacePoint ClosestPointOnTriangle(const TriangleMesh& mesh, int triangle, const Vector3& point);

/// The point of the surface that is nearest to `point`, by looking at every triangle; of equally near triangles the
/// first. TriangleTree finds the same one faster. @throws Error if there is no
/// triangle.
SurfacePoint ClosestPointOnMesh(const TriangleMesh& mesh, const Vector3& point);

}  // namespace daumier::geometry
