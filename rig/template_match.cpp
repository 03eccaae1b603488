#include "rig/template_match.h"

#include "geometry/normals.h"
#include "geometry/path.h"

#include <algorithm>
#include <array>
#include <limits>

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

/// Of each vertex the way along the surface to the nearest vertex of the other side of its slit; 0 without a side.
std::vector<double> WaysAcross(const geometry::TriangleMesh& surface, const std::vector<FaceSide>& sides) {
  const auto neighbours = geometry::VertexNeighbours(surface.triangles, int(surface.vertices.rows()));
  std::vector<double> ways(sides.size(), 0.0);
  for (int s = 1; s <= 2 * kNumFaceSlits; ++s) {
    std::vector<int> others;
    for (size_t v = 0; v < sides.size(); ++v)
      if (sides[v] == OppositeSide(FaceSide(s))) others.push_back(int(v));
    const auto nearest =
        geometry::FindNearestSeeds(surface.vertices, neighbours, others, std::numeric_limits<double>::infinity());
    for (size_t v = 0; v < sides.size(); ++v)
      if (sides[v] == FaceSide(s)) ways[v] = nearest.distances[v];
  }
  return ways;
}

}  // namespace

TemplateMatch::TemplateMatch(const geometry::TriangleMesh& surface, const FaceSlits& slits,
                             const std::vector<FaceSide>& sides)
    : tree_(surface), normals_(geometry::TriangleNormals(surface)), slits_(slits) {
  for (const auto& corners : surface.triangles.rowwise()) triangle_sides_.push_back(SideOfCorners(sides, corners));
  const std::vector<double> ways = WaysAcross(surface, sides);
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    double way = std::numeric_limits<double>::infinity();
    for (const int v : surface.triangles.row(t)) way = std::min(way, ways[size_t(v)]);
    ways_across_.push_back(way);
  }
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
