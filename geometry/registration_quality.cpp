#include "geometry/registration_quality.h"

#include "core/error.h"
#include "core/statistics.h"
#include "geometry/flips.h"
#include "geometry/normals.h"
#include "geometry/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace daumier::geometry {

std::optional<DistanceSpread> SpreadOf(std::span<const double> distances) {
  if (distances.empty()) return std::nullopt;
  return DistanceSpread{Mean(distances), Median(distances), Percentile(distances, 95)};
}

RegistrationQuality MeasureRegistration(const TriangleMesh& rest, const Points& vertices,
                                        const std::vector<int>& region, const SurfaceMatcher& target,
                                        const MatchLimits& limits) {
  DAUMIER_CHECK(vertices.rows() == rest.vertices.rows(), "{} registered vertices, the template has {}", vertices.rows(),
                rest.vertices.rows());
  DAUMIER_CHECK(!region.empty(), "the region that is to be measured has no vertex");
  RegistrationQuality quality;
  const TriangleMesh registered{vertices, rest.triangles};
  const Points normals = VertexNormals(registered);
  quality.distances.setConstant(vertices.rows(), std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < vertices.rows(); ++v) {
    if (const auto match = target.Match(vertices.row(v), normals.row(v), limits))
      quality.distances[v] = match->distance;
  }

  const Eigen::VectorXd areas = VertexAreas(rest);
  std::vector<double> matched;
  double matched_area = 0;
  for (const int v : region) {
    if (std::isnan(quality.distances[v])) continue;
    matched.push_back(quality.distances[v]);
    matched_area += areas[v];
  }
  quality.template_to_target = SpreadOf(matched);
  quality.coverage = matched_area / areas(region).sum();

  const TriangleTree tree(registered);
  const Eigen::VectorXd target_areas = VertexAreas(target.mesh());
  const Triangles& target_triangles = target.mesh().triangles;
  const std::set<int> used(target_triangles.data(), target_triangles.data() + target_triangles.size());
  std::vector<double> back;
  double reached_area = 0;
  for (const int v : used) {
    back.push_back(tree.Closest(target.mesh().vertices.row(v)).distance);
    if (back.back() <= limits.distance) reached_area += target_areas[v];
  }
  quality.target_to_template = SpreadOf(back).value();  // A tree has a triangle.
  quality.target_reached = reached_area / target_areas.sum();

  const std::set<int> in_region(region.begin(), region.end());
  for (const auto triangle : rest.triangles.rowwise()) {
    quality.num_region_triangles +=
        std::all_of(triangle.begin(), triangle.end(), [&](int v) { return in_region.count(v) > 0; });
  }
  for (const int f : FlippedTriangles(rest.vertices, vertices, rest.triangles, region)) {
    ++quality.flipped_region;
    bool is_matched = true;
    for (const int v : rest.triangles.row(f)) is_matched = is_matched && !std::isnan(quality.distances[v]);
    quality.flipped_matched += is_matched;
  }
  quality.self_intersections = static_cast<int>(SelfIntersections(registered).size());
  quality.self_intersections_at_rest = static_cast<int>(SelfIntersections(rest).size());
  return quality;
}

}  // namespace daumier::geometry
