#include "rig/head_slits.h"

#include "core/parallel.h"
#include "geometry/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kAround = 1.0;      // How far from its middle places have sides, in widths.
constexpr double kFarNearer = 0.1;   // By how much a place has to be nearer to a side than to the other, in widths.
constexpr double kOnTemplate = 0.5;  // Of a place that lies on the template, cm.
constexpr double kCorner = 0.1;      // How near places are to the other side along the surface, in widths.
constexpr double kWayPerGap = 1.25, kWayPerWidth = 0.12;      // The longest way of a sealed slit.
constexpr std::array<double, 3> kMiddle = {0.35, 0.5, 0.65};  // Where a slit is tested, along its length.

/// A slit on the registered template.
struct SlitPlace {
  const SeamEdges& edges;
  FaceSide upper, lower;
  geometry::Vector3 centre;
  double width;
};

SlitPlace PlaceOfSlit(const TemplateMatch& match, FaceSlit slit) {
  const SeamEdges& edges = match.slits()[size_t(slit)];
  const geometry::Points& points = match.surface().vertices;
  const Eigen::RowVector3d right = points.row(edges.upper.front()), left = points.row(edges.upper.back());
  return {edges, UpperSide(slit), LowerSide(slit), 0.5 * (right + left).transpose(), (right - left).norm()};
}

enum class SeedKind : char { kNone, kApart, kUpper, kLower };

/// What a place is by the template alone.
SeedKind SeedOf(const TemplateMatch& match, const SlitPlace& slit, const geometry::Vector3& point,
                const geometry::Vector3& normal) {
  const double margin = kFarNearer * slit.width, reach = kOnTemplate + margin;
  const auto distance = [&](const auto& is_allowed) {
    const auto nearest = match.Nearest(point, normal, reach, is_allowed);
    return nearest ? nearest->distance : std::numeric_limits<double>::infinity();
  };
  const double upper = distance([&](FaceSide side) { return side == slit.upper; }),
               lower = distance([&](FaceSide side) { return side == slit.lower; }),
               apart = distance([&](FaceSide side) { return side != slit.upper && side != slit.lower; });
  if (std::min({upper, lower, apart}) > kOnTemplate) return SeedKind::kNone;
  if (apart + margin < std::min(upper, lower)) return SeedKind::kApart;
  if (upper <= apart && upper + margin < lower) return SeedKind::kUpper;
  if (lower <= apart && lower + margin < upper) return SeedKind::kLower;
  return SeedKind::kNone;
}

/// Where the surface continues from side to side, at the corners, floods meet by chance: the sides are those of the template
/// there, where it has a place that faces likewise.
void SettleCorners(const TemplateMatch& match, const HeadSurface& head, const SlitPlace& slit,
                   const std::vector<int>& around, const std::vector<bool>& is_around, std::vector<FaceSide>& sides) {
  std::array<std::vector<int>, 2> of_sides;
  for (const int p : around) {
    if (sides[size_t(p)] == slit.upper) of_sides[0].push_back(p);
    if (sides[size_t(p)] == slit.lower) of_sides[1].push_back(p);
  }
  const double reach = kCorner * slit.width;
  std::vector<std::pair<int, FaceSide>> settled;
  for (size_t other = 0; other < 2; ++other) {
    const auto nearest =
        geometry::FindNearestSeeds(head.mesh.vertices, head.neighbours, of_sides[other], reach, is_around);
    for (const int p : of_sides[1 - other]) {
      if (nearest.seeds[size_t(p)] < 0) continue;
      const auto point =
          match.Nearest(head.mesh.vertices.row(p), head.normals.row(p), kOnTemplate, [](FaceSide) { return true; });
      if (point) settled.emplace_back(p, match.side(point->triangle));
    }
  }
  for (const auto& [p, side] : settled) sides[size_t(p)] = side;
}

/// Sets the sides of the places around one slit; of those alone that have none yet.
void FloodSides(const TemplateMatch& match, const HeadSurface& head, const SlitPlace& slit,
                std::vector<FaceSide>& sides) {
  std::vector<bool> is_around(size_t(head.num_places()), false);
  std::vector<int> around;
  for (int p = 0; p < head.num_places(); ++p) {
    is_around[size_t(p)] = (head.mesh.vertices.row(p).transpose() - slit.centre).norm() <= kAround * slit.width;
    if (is_around[size_t(p)]) around.push_back(p);
  }
  std::vector<SeedKind> kinds(around.size());
  OnAllCores(std::ssize(around), [&](int64_t i) {
    const int p = around[size_t(i)];
    kinds[size_t(i)] = SeedOf(match, slit, head.mesh.vertices.row(p), head.normals.row(p));
  });
  std::vector<int> seeds;
  std::vector<SeedKind> of_seeds;
  for (size_t i = 0; i < around.size(); ++i) {
    if (kinds[i] == SeedKind::kNone) continue;
    seeds.push_back(around[i]);
    of_seeds.push_back(kinds[i]);
  }
  const auto nearest = geometry::FindNearestSeeds(head.mesh.vertices, head.neighbours, seeds,
                                                  std::numeric_limits<double>::infinity(), is_around);
  for (const int p : around) {
    const int seed = nearest.seeds[size_t(p)];
    if (seed < 0 || sides[size_t(p)] != FaceSide::kNone) continue;
    if (of_seeds[size_t(seed)] == SeedKind::kUpper) sides[size_t(p)] = slit.upper;
    if (of_seeds[size_t(seed)] == SeedKind::kLower) sides[size_t(p)] = slit.lower;
  }
  SettleCorners(match, head, slit, around, is_around, sides);
}

/// The connected part with most places of a slit's sides: not what covers an eye or hangs between lids.
int ComponentOfSlit(const HeadSurface& head, const std::vector<FaceSide>& sides, const SlitPlace& slit) {
  std::vector<int> counts(size_t(head.num_components()), 0);
  for (size_t p = 0; p < sides.size(); ++p)
    if (sides[p] == slit.upper || sides[p] == slit.lower) ++counts[size_t(head.components[p])];
  return int(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

/// The place of a side and a connected part that is nearest to a point; -1 without one.
int NearestOfSide(const HeadSurface& head, const std::vector<FaceSide>& sides, FaceSide side, int component,
                  const Eigen::RowVector3d& point) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < head.num_places(); ++p) {
    if (sides[size_t(p)] != side || head.components[size_t(p)] != component) continue;
    const double distance = (head.mesh.vertices.row(p) - point).squaredNorm();
    if (distance < least) least = distance, best = p;
  }
  return best;
}

HeadSlit Tested(const TemplateMatch& match, const HeadSurface& head, const SlitPlace& slit,
                const std::vector<FaceSide>& sides) {
  const geometry::Points& points = match.surface().vertices;
  const auto at = [&](const std::vector<int>& path, double share) {
    return Eigen::RowVector3d(points.row(path[size_t(std::lround(share * double(path.size() - 1)))]));
  };
  const int component = ComponentOfSlit(head, sides, slit);
  HeadSlit result;
  for (const double share : kMiddle) {
    const int upper = NearestOfSide(head, sides, slit.upper, component, at(slit.edges.upper, share)),
              lower = NearestOfSide(head, sides, slit.lower, component, at(slit.edges.lower, share));
    if (upper < 0 || lower < 0) return result;
    const auto ways = geometry::FindNearestSeeds(head.mesh.vertices, head.neighbours, {upper}, 3 * slit.width);
    result.way += ways.distances[size_t(lower)] / double(kMiddle.size());
    result.gap += (head.mesh.vertices.row(upper) - head.mesh.vertices.row(lower)).norm() / double(kMiddle.size());
  }
  result.is_found = true;
  result.component = component;
  result.is_sealed = result.way <= kWayPerGap * result.gap + kWayPerWidth * slit.width;
  return result;
}

}  // namespace

HeadSlits FindHeadSlits(const TemplateMatch& match, const HeadSurface& head) {
  HeadSlits result;
  result.sides.assign(size_t(head.num_places()), FaceSide::kNone);
  for (int s = 0; s < kNumFaceSlits; ++s) {
    if (match.slits()[size_t(s)].upper.empty()) continue;
    const SlitPlace slit = PlaceOfSlit(match, FaceSlit(s));
    FloodSides(match, head, slit, result.sides);
    result.slits[size_t(s)] = Tested(match, head, slit, result.sides);
  }
  return result;
}

}  // namespace daumier::rig
