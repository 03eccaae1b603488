#pragma once
#include "geometry/triangle_tree.h"

#include <array>
#include <optional>
#include <vector>

namespace daumier::geometry {

/// When a closest point is no correspondence.
struct MatchLimits {
  double distance = 1.0;      ///< cm; farther ones are refused.
  double angle_degrees = 60;  ///< Between the normals of the two surfaces.
};

/// Finds correspondences on a surface of any topology, with holes or without: its closest points, of which those are
/// refused that lie too far away, whose surface faces elsewhere, or that lie on the border, where a surface that goes
/// on beyond it piles up. The border are the edges that belong to one triangle.
class SurfaceMatcher {
 public:
  /// @throws Error as TriangleTree.
  explicit SurfaceMatcher(TriangleMesh target);

  /// The correspondence of a point whose surface has the unit normal `normal`.
  std::optional<SurfacePoint> Match(const Vector3& point, const Vector3& normal, const MatchLimits& limits) const;

  const TriangleMesh& mesh() const { return tree_.mesh(); }

 private:
  bool IsOnBorder(const SurfacePoint& point) const;

  TriangleTree tree_;
  Points vertex_normals_;
  std::vector<std::array<bool, 3>> is_border_edge_;  ///< Of the edges opposite to each triangle's corners.
  std::vector<bool> is_border_vertex_;
};

}  // namespace daumier::geometry
