#pragma once
#include "geometry/triangle_tree.h"
#include "rig/face_sides.h"

#include <functional>
#include <optional>
#include <vector>

namespace daumier::rig {

/// A registered template on which places of another head find theirs, never across a slit.
class TemplateMatch {
 public:
  /// surface: the registered template, in its own frame (cm). slits: of its topology; sides: SidesOfTemplate.
  TemplateMatch(const geometry::TriangleMesh& surface, const FaceSlits& slits, const std::vector<FaceSide>& sides);

  /// The nearest point of the template within `reach` cm whose triangle faces as `normal` does (kLeastCosine) and whose
  /// side is allowed.
  std::optional<geometry::SurfacePoint> Nearest(const geometry::Vector3& point, const geometry::Vector3& normal,
                                                double reach, const std::function<bool(FaceSide)>& is_allowed) const;

  /// The nearest point of all.
  geometry::SurfacePoint NearestOfAll(const geometry::Vector3& point) const { return tree_.Closest(point); }

  /// The side of a triangle: of its corners that have one; kNone if they have both of one slit.
  FaceSide side(int triangle) const { return triangle_sides_[size_t(triangle)]; }
  /// The way along the template from a triangle with a side to the other side of its slit, cm: long but near its corners.
  /// 0 for a triangle without a side.
  double WayAcross(int triangle) const { return ways_across_[size_t(triangle)]; }
  const FaceSlits& slits() const { return slits_; }
  const geometry::TriangleMesh& surface() const { return tree_.mesh(); }

  /// Between normals that agree.
  static constexpr double kLeastCosine = 0.3;

 private:
  geometry::TriangleTree tree_;
  geometry::Points normals_;  ///< Of the triangles.
  FaceSlits slits_;
  std::vector<FaceSide> triangle_sides_;
  std::vector<double> ways_across_;  ///< Of triangles.
};

}  // namespace daumier::rig
