#include "rig/template_match.h"

#include "geometry/normals.h"

#include <algorithm>
#include <array>

namespace daumier::rig {
namespace {

FaceSide SideOfCorners(const std::vector<FaceSide>& sides, const Eigen::RowVector3i& corners) {
  FaceSide side = FaceSide::kNone;
  for (const int v : corners) {
    const FaceSide of_corner = sides[size_t(v)];
    if (of_corner == FaceSide::kNone) continue;
    if (side == OppositeSide(of_corner)) return FaceSide::kNone;
    side = of_corner;
  }
  return side;
}

}  // namespace

TemplateMatch::TemplateMatch(const geometry::TriangleMesh& surface, const FaceSlits& slits,
                             const std::vector<FaceSide>& sides)
    : tree_(surface), normals_(geometry::TriangleNormals(surface)), slits_(slits) {
  for (const auto& corners : surface.triangles.rowwise()) triangle_sides_.push_back(SideOfCorners(sides, corners));
}

std::optional<geometry::SurfacePoint> TemplateMatch::Nearest(const geometry::Vector3& point,
                                                             const geometry::Vector3& normal, double reach,
                                                             const std::function<bool(FaceSide)>& is_allowed) const {
  constexpr std::array<double, 3> kShares = {0.15, 0.4, 1.0};  // Of the reach: most places lie on the template.
  for (const double share : kShares) {
    const geometry::Vector3 half = geometry::Vector3::Constant(share * reach);
    std::optional<geometry::SurfacePoint> best;
    for (const int t : tree_.Overlapping({point - half, point + half})) {
      if (normals_.row(t).dot(normal.transpose()) < kLeastCosine || !is_allowed(side(t))) continue;
      const geometry::SurfacePoint candidate = geometry::ClosestPointOnTriangle(tree_.mesh(), t, point);
      if (candidate.distance <= share * reach && (!best || candidate.distance < best->distance)) best = candidate;
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace daumier::rig
