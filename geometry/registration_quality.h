#pragma once
#include "geometry/mesh.h"
#include "geometry/surface_matcher.h"

#include <optional>
#include <span>
#include <vector>

namespace daumier::geometry {

/// Of some distances, cm.
struct DistanceSpread {
  double mean = 0, median = 0, p95 = 0;
};
/// Mean, Median and Percentile 95 of core/statistics.h; nothing if there is no distance.
std::optional<DistanceSpread> SpreadOf(std::span<const double> distances);

/// How well a template lies on a target in the same frame. The region are the vertices that ought to be matched.
struct RegistrationQuality {
  Eigen::VectorXd distances;  ///< V: of each vertex to its match (SurfaceMatcher), cm; NaN without one.
  std::optional<DistanceSpread> template_to_target;  ///< Over the region's vertices with a match, if any has one.
  /// From every vertex of the target's triangles to the closest point of the template.
  DistanceSpread target_to_template;
  double coverage = 0;                 ///< Share of the region's area at rest whose vertices have a match.
  double target_reached = 0;           ///< Share of the target's area whose vertices are within limits.distance.
  int num_region_triangles = 0;        ///< Triangles between vertices of the region.
  int flipped_region = 0;              ///< Those of them that are flipped.
  int flipped_matched = 0;             ///< Flipped ones with a match at all three corners.
  int self_intersections = 0;          ///< Pairs of triangles of the registered template.
  int self_intersections_at_rest = 0;  ///< Of the template before.
};

/// `rest`: the template at rest; `vertices`: the registered one, V x 3; region: sorted vertices. @throws Error if a
/// shape disagrees, the region is empty, or as SelfIntersections.
RegistrationQuality MeasureRegistration(const TriangleMesh& rest, const Points& vertices,
                                        const std::vector<int>& region, const SurfaceMatcher& target,
                                        const MatchLimits& limits);

}  // namespace daumier::geometry
