#include "rig/seam_cut.h"

#include "geometry/line_cut.h"
#include "rig/cut_pocket.h"
#include "rig/seam_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kAroundLine = 0.5;    // Beyond the corners and on both sides of a line, in widths.
constexpr double kDepthOfLine = 0.25;  // In front of a line and behind it, in widths.
constexpr double kTurnedAway = -0.2;   // Cosine between a normal and the direction out of the skin.
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

/// The height over a line of the vertices around it.
struct HeightsOverLine {
  Eigen::VectorXd heights;      ///< V; 1 away from the line.
  std::vector<bool> is_around;  ///< V
};

HeightsOverLine HeightsOver(const SeamLine& line, int component, const HeadSurface& surface,
                            const geometry::Points& vertices) {
  const Eigen::Index num_vertices = vertices.rows();
  HeightsOverLine over{Eigen::VectorXd::Ones(num_vertices), std::vector<bool>(size_t(num_vertices), false)};
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    const int place = surface.places[size_t(v)];
    if (place < 0 || surface.components[size_t(place)] != component ||
        surface.normals.row(place).dot(line.frame.out.transpose()) < kTurnedAway)
      continue;
    const geometry::Vector3 at = line.Coordinates(vertices.row(v));
    const double height = at.y() - line.HeightAt(at.x()), around = kAroundLine * line.width;
    if (at.x() < -around || at.x() > line.width + around || std::abs(height) > around ||
        std::abs(at.z() - line.DepthAt(at.x())) > kDepthOfLine * line.width)
      continue;
    over.heights[v] = height;
    over.is_around[size_t(v)] = true;
  }
  return over;
}

/// Lips that bulge over their seam cross its height again, in front of it: the deepest crossing is the seam.
class DeepestCrossing {
 public:
  DeepestCrossing(const SeamLine& line, const HeightsOverLine& over, const geometry::TriangleMesh& mesh)
      : line_(line), deepest_(kNumBins, std::numeric_limits<double>::infinity()) {
    for (const auto& t : mesh.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        if (!over.is_around[size_t(a)] || !over.is_around[size_t(b)] || over.heights[a] * over.heights[b] > 0) continue;
        const double sum = std::abs(over.heights[a]) + std::abs(over.heights[b]);
        const double share = sum > 0 ? std::abs(over.heights[a]) / sum : 0;
        const geometry::Vector3 at =
            line.Coordinates((1 - share) * mesh.vertices.row(a) + share * mesh.vertices.row(b));
        double& deepest = deepest_[BinOf(at)];
        deepest = std::min(deepest, at.z() - line.DepthAt(at.x()));
      }
    }
  }

  /// at: coordinates of a crossing.
  bool Has(const geometry::Vector3& at) const {
    const size_t bin = BinOf(at);
    const auto first = deepest_.begin() + std::ptrdiff_t(bin > 0 ? bin - 1 : 0),
               last = deepest_.begin() + std::ptrdiff_t(std::min(bin + 2, kNumBins));
    return at.z() - line_.DepthAt(at.x()) <= *std::min_element(first, last) + kOneDepth * line_.width;
  }

 private:
  static constexpr size_t kNumBins = 32;     // Along the line.
  static constexpr double kOneDepth = 0.03;  // In widths.
  size_t BinOf(const geometry::Vector3& at) const {
    return size_t(std::clamp(at.x() / line_.width, 0.0, 1.0) * double(kNumBins - 1) + 0.5);
  }

  const SeamLine& line_;
  std::vector<double> deepest_;  ///< In front of the line.
};

geometry::LineCut CutAlong(const SeamLine& line, const HeightsOverLine& over, const geometry::TriangleMesh& mesh) {
  const DeepestCrossing deepest(line, over, mesh);
  return geometry::CutAlongLine(mesh, over.heights, [&](const geometry::EdgePoint& point) {
    if (!over.is_around[size_t(point.kept)] || !over.is_around[size_t(point.removed)]) return false;
    const geometry::Vector3 at = line.Coordinates((1 - point.share) * mesh.vertices.row(point.kept) +
                                                  point.share * mesh.vertices.row(point.removed));
    return at.x() >= -kOnLine * line.width && at.x() <= (1 + kOnLine) * line.width && deepest.Has(at);
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
  // Cuts of eyes first: what the pocket adds is the last. Each has the vertices of the head alone; the others are at
  // another slit.
  for (int s = kNumFaceSlits - 1; s >= 0; --s) {
    opened.slits[size_t(s)] = WhatToDo(match, slits, s);
    if (opened.slits[size_t(s)] != SlitCut::kCut) continue;
    SeamLine line = MiddleOfSlit(match.slits()[size_t(s)], match.surface().vertices);
    DrawToGroove(surface, line);
    HeightsOverLine over = HeightsOver(line, slits.slits[size_t(s)].component, surface, head.vertices);
    over.heights.conservativeResize(opened.mesh.vertices.rows());
    over.heights.tail(opened.mesh.vertices.rows() - head.vertices.rows()).setOnes();
    over.is_around.resize(size_t(opened.mesh.vertices.rows()), false);
    geometry::LineCut cut = CutAlong(line, over, opened.mesh);
    if (cut.edges.empty()) {
      opened.slits[size_t(s)] = SlitCut::kNoLine;
      continue;
    }
    opened.lengths[size_t(s)] = cut.length;
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
