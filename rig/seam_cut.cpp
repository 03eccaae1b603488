#include "rig/seam_cut.h"

#include "geometry/line_cut.h"
#include "rig/cut_pocket.h"
#include "rig/seam_line.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kAroundLine = 0.3;    // Beyond the corners, on both sides of a line and from the template, in widths.
constexpr double kDepthOfLine = 0.25;  // In front of a line and behind it, in widths.
constexpr double kOnLine = 1e-6;       // In widths.

bool IsClosed(const SeamEdges& edges, const geometry::Points& registered, double width) {
  const auto middle = [&](const std::vector<int>& path) { return registered.row(path[path.size() / 2]); };
  return (middle(edges.upper) - middle(edges.lower)).norm() <= kClosedEye * width;
}

/// What an eye or a mouth that is sealed needs.
SlitCut WhatToDo(const TemplateMatch& match, const HeadSlits& slits, int s) {
  const HeadSlit& slit = slits.slits[size_t(s)];
  if (!slit.is_found || !slit.is_sealed) return SlitCut::kNotSealed;
  if (s == int(FaceSlit::kMouth)) return SlitCut::kCut;
  const SeamEdges& edges = match.slits()[size_t(s)];
  const geometry::Points& registered = match.surface().vertices;
  const double width = (registered.row(edges.upper.back()) - registered.row(edges.upper.front())).norm();
  return IsClosed(edges, registered, width) ? SlitCut::kCut : SlitCut::kOpenEye;
}

/// How much nearer places are to the upper side of the template than to the lower one, cm: lips that bulge over their seam
/// cross its height several times, and this once.
class Nearness {
 public:
  Nearness(const TemplateMatch& match, FaceSlit slit, double reach)
      : match_(match), upper_(UpperSide(slit)), lower_(LowerSide(slit)), reach_(reach) {}

  /// Nothing where neither is within reach.
  std::optional<double> Of(const geometry::Vector3& place, const geometry::Vector3& normal) const {
    const double upper = Distance(place, normal, upper_), lower = Distance(place, normal, lower_);
    if (std::min(upper, lower) >= reach_) return std::nullopt;
    return lower - upper;
  }

 private:
  double Distance(const geometry::Vector3& place, const geometry::Vector3& normal, FaceSide side) const {
    const auto point = match_.Nearest(place, normal, reach_, [&](FaceSide of_triangle) { return of_triangle == side; });
    return point ? point->distance : reach_;
  }

  const TemplateMatch& match_;
  FaceSide upper_, lower_;
  double reach_;
};

/// A function of the vertices whose zero line is the seam.
struct SidesOfLine {
  Eigen::VectorXd values;       ///< V, cm; 1 away from the line.
  std::vector<bool> is_around;  ///< V
};

/// middle: between the sides of the template. drawn: to the groove.
SidesOfLine SidesAround(const TemplateMatch& match, int s, const SeamLine& middle, const SeamLine& drawn, int component,
                        const HeadSurface& surface, const geometry::TriangleMesh& head) {
  const Eigen::Index num_vertices = head.vertices.rows();
  SidesOfLine sides{Eigen::VectorXd::Ones(num_vertices), std::vector<bool>(size_t(num_vertices), false)};
  const double around = kAroundLine * middle.width;
  const Nearness nearness(match, FaceSlit(s), around);
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    const int place = surface.places[size_t(v)];
    if (place < 0 || surface.components[size_t(place)] != component) continue;
    const geometry::Vector3 at = middle.Coordinates(head.vertices.row(v));
    if (at.x() < -around || at.x() > middle.width + around || std::abs(at.y() - middle.HeightAt(at.x())) > around ||
        std::abs(at.z() - middle.DepthAt(at.x())) > kDepthOfLine * middle.width)
      continue;
    const auto nearer = nearness.Of(head.vertices.row(v), surface.normals.row(place));
    if (!nearer) continue;
    sides.values[v] = *nearer - (drawn.HeightAt(at.x()) - middle.HeightAt(at.x()));
    sides.is_around[size_t(v)] = true;
  }
  return sides;
}

geometry::LineCut CutAlong(const SeamLine& line, const SidesOfLine& sides, const geometry::TriangleMesh& mesh) {
  return geometry::CutAlongLine(mesh, sides.values, [&](const geometry::EdgePoint& point) {
    if (!sides.is_around[size_t(point.kept)] || !sides.is_around[size_t(point.removed)]) return false;
    const geometry::Vector3 at = line.Coordinates((1 - point.share) * mesh.vertices.row(point.kept) +
                                                  point.share * mesh.vertices.row(point.removed));
    return at.x() >= -kOnLine * line.width && at.x() <= (1 + kOnLine) * line.width;
  });
}

bool HasMouthParts(const HeadParts& parts) {
  return std::ranges::any_of(parts.of_components, [](HeadPart part) {
    return part == HeadPart::kUpperMouth || part == HeadPart::kLowerMouth || part == HeadPart::kWholeMouth;
  });
}

/// Sources of the cut's triangles among those of the head.
void Compose(const std::vector<int>& before, std::vector<int>& sources) {
  for (int& source : sources)
    if (source >= 0) source = before[size_t(source)];
}

}  // namespace

OpenedHead OpenSealedSlits(const TemplateMatch& match, const HeadSurface& surface, const HeadParts& parts,
                           const HeadSlits& slits, const geometry::TriangleMesh& head) {
  OpenedHead opened;
  opened.mesh = head;
  for (int t = 0; t < head.triangles.rows(); ++t) opened.sources.push_back(t);
  // Cuts of eyes first: what the pocket adds is the last. Each cut has values of the vertices of the head alone; the others
  // are at another slit.
  for (int s = kNumFaceSlits - 1; s >= 0; --s) {
    opened.slits[size_t(s)] = WhatToDo(match, slits, s);
    if (opened.slits[size_t(s)] != SlitCut::kCut) continue;
    const SeamLine middle = MiddleOfSlit(match.slits()[size_t(s)], match.surface().vertices);
    SeamLine line = middle;
    DrawToGroove(surface, line);
    SidesOfLine sides = SidesAround(match, s, middle, line, slits.slits[size_t(s)].component, surface, head);
    const Eigen::Index num_new = opened.mesh.vertices.rows() - head.vertices.rows();
    sides.values.conservativeResize(opened.mesh.vertices.rows());
    sides.values.tail(num_new).setOnes();
    sides.is_around.resize(size_t(opened.mesh.vertices.rows()), false);
    geometry::LineCut cut = CutAlong(line, sides, opened.mesh);
    if (cut.edges.empty()) {
      opened.slits[size_t(s)] = SlitCut::kNoLine;
      continue;
    }
    opened.lengths[size_t(s)] = cut.length;
    opened.widths[size_t(s)] = line.width;
    for (const geometry::RimVertex& place : cut.rim)
      if (place.above != place.below) cut.mesh.vertices.row(place.above) += kCutGap * line.frame.up.transpose();
    opened.num_cut_vertices = int(cut.mesh.vertices.rows() - head.vertices.rows());
    if (s == int(FaceSlit::kMouth) && !HasMouthParts(parts)) AddPocket(line, cut);
    Compose(opened.sources, cut.sources);
    opened.mesh = std::move(cut.mesh);
    opened.sources = std::move(cut.sources);
  }
  return opened;
}

}  // namespace daumier::rig
