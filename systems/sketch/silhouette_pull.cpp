#include "systems/sketch/silhouette_pull.h"

#include "geometry/normals.h"
#include "render/contour_chains.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace daumier::sketch {
namespace {

/// So few hidden points between visible ones do not cut a silhouette.
constexpr size_t kMostHidden = 2;

/// Short hidden stretches between visible ones made visible. A closed chain repeats its first point.
void FillShortGaps(std::vector<bool>& is_seen) {
  size_t last_seen = is_seen.size();
  for (size_t i = 0; i < is_seen.size(); ++i) {
    if (!is_seen[i]) continue;
    if (last_seen < i && i - last_seen - 1 <= kMostHidden)
      std::fill(is_seen.begin() + std::ptrdiff_t(last_seen), is_seen.begin() + std::ptrdiff_t(i), true);
    last_seen = i;
  }
}

/// A closed chain, which repeats its first point, begun at another one.
void BeginAt(render::ContourChain& chain, std::vector<bool>& is_seen, size_t first) {
  const Eigen::Index count = chain.points.rows() - 1, shift = Eigen::Index(first);
  geometry::Points points(count + 1, 3);
  points << chain.points.middleRows(shift, count - shift), chain.points.topRows(shift), chain.points.row(shift);
  chain.points = points;
  const auto rotate = [&](auto& values) {
    values.pop_back();
    std::rotate(values.begin(), values.begin() + shift, values.end());
    values.push_back(values.front());
  };
  rotate(chain.edges);
  rotate(is_seen);
}

/// A part of a line, and where its points are to be.
struct MatchedPart {
  std::vector<size_t> points;
  CanvasPoints targets;
  double distance = 0, farthest = 0;  ///< Of points from targets, mean and greatest, pixels.
};

/// The points of a line from one share of its length to another, forwards, beyond its end if it is closed, matched with
/// the stroke; the stroke is drawn in this direction.
MatchedPart MatchedFrom(const SurfaceLine& line, double from, double to, const CanvasPoints& stroke) {
  const std::vector<double> arcs = datasets::ArcLengths(line.points);
  const double length = arcs.back(), span = to - from;
  const size_t count = line.points.size() - (line.closed ? 1 : 0);
  std::vector<std::pair<double, size_t>> on_part;
  for (size_t i = 0; i < count; ++i) {
    double share = arcs[i] / length;
    if (line.closed && share < from) share += 1;
    if (share >= from && share <= to) on_part.emplace_back((share - from) / span, i);
  }
  std::ranges::sort(on_part);
  MatchedPart part;
  for (const auto& [share, i] : on_part) {
    part.points.push_back(i);
    part.targets.push_back(datasets::AtShare(stroke, share));
    const double distance = (part.targets.back() - line.points[i]).norm();
    part.distance += distance / double(on_part.size());
    part.farthest = std::max(part.farthest, distance);
  }
  return part;
}

/// The ways of matching a stroke with a line.
std::vector<MatchedPart> MatchedParts(const SurfaceLine& line, const CanvasPoints& stroke) {
  std::vector<MatchedPart> parts;
  if (line.points.size() < 2 || !(datasets::LengthOf(line.points) > 0)) return parts;
  const double first = datasets::ShareNearest(line.points, stroke.front());
  const double last = datasets::ShareNearest(line.points, stroke.back());
  const CanvasPoints reversed = datasets::Reversed(stroke);
  const auto add = [&](double from, double to, const CanvasPoints& drawn) {
    if (line.closed && to < from) to += 1;
    if (to <= from) return;
    MatchedPart part = MatchedFrom(line, from, to, drawn);
    if (part.points.size() > 1) parts.push_back(std::move(part));
  };
  add(first, last, stroke);
  add(last, first, reversed);
  return parts;
}

LinePull PullOf(const SurfaceLine& line, const MatchedPart& part) {
  struct Moves {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
  };
  std::map<int, Moves> by_vertex;
  for (size_t k = 0; k < part.points.size(); ++k) {
    const std::array<int, 2>& edge = line.vertices[part.points[k]];
    for (const int v : std::set<int>{edge[0], edge[1]}) {
      Moves& moves = by_vertex[v];
      moves.sum += part.targets[k] - line.points[part.points[k]];
      ++moves.count;
    }
  }
  LinePull pull{{}, Eigen::MatrixX2d(Eigen::Index(by_vertex.size()), 2), part.distance};
  for (const auto& [vertex, moves] : by_vertex) {
    pull.moves.row(std::ssize(pull.vertices)) = moves.sum / moves.count;
    pull.vertices.push_back(vertex);
  }
  return pull;
}

}  // namespace

std::vector<SurfaceLine> VisibleSilhouettes(const geometry::TriangleMesh& mesh, const render::Camera& camera,
                                            const VisibleSurface& surface) {
  const Eigen::Index num_vertices = mesh.vertices.rows();
  const Eigen::Vector3d towards_viewer = -camera.camera_from_world.row(2);
  // A radial curvature of 1 counts for all: contours of concave parts are hidden anyway.
  const render::ViewCurvature view{geometry::VertexNormals(mesh) * towards_viewer, Eigen::VectorXd::Ones(num_vertices),
                                   Eigen::VectorXd::Zero(num_vertices)};
  std::vector<SurfaceLine> lines;
  for (render::ContourChain& chain : render::ChainContours(render::OccludingContours(mesh, view))) {
    std::vector<bool> is_seen = surface.Sees(chain.points);
    FillShortGaps(is_seen);
    const auto hidden = std::ranges::find(is_seen, false);
    if (chain.closed && hidden != is_seen.end()) BeginAt(chain, is_seen, size_t(hidden - is_seen.begin()));
    const geometry::Points projected = render::Project(camera, chain.points);
    SurfaceLine line;
    const auto finish = [&] {
      line.closed = chain.closed && line.points.size() == is_seen.size();
      if (line.points.size() > 1) lines.push_back(line);
      line = {};
    };
    for (size_t i = 0; i < is_seen.size(); ++i) {
      if (!is_seen[i]) {
        finish();
        continue;
      }
      line.points.emplace_back(projected.row(Eigen::Index(i)).head<2>());
      line.vertices.push_back(chain.edges[i]);
    }
    finish();
  }
  return lines;
}

SurfaceLine DefinedSilhouette(const faces::Annotation& annotation, faces::View view,
                              const geometry::Points& projected) {
  const char* const kind = view == faces::View::kFrontal ? "silhouette" : "side_silhouette";
  const auto at = [&](int v) -> Eigen::Vector2d { return projected.row(v).head<2>(); };
  std::vector<int> joined;
  bool is_closed = false;
  for (const faces::FeatureCurve& curve : annotation.curves) {
    if (curve.kind != kind) continue;
    is_closed = joined.empty() && curve.closed;
    std::vector<int> next = curve.vertices;
    if (!joined.empty()) {
      const auto gap = [&](int a, int b) { return (at(a) - at(b)).norm(); };
      const double from_front = std::min(gap(joined.front(), next.front()), gap(joined.front(), next.back()));
      const double from_back = std::min(gap(joined.back(), next.front()), gap(joined.back(), next.back()));
      if (from_front < from_back) std::ranges::reverse(joined);
      if (gap(joined.back(), next.back()) < gap(joined.back(), next.front())) std::ranges::reverse(next);
    }
    joined.insert(joined.end(), next.begin(), next.end());
  }
  if (is_closed) joined.push_back(joined.front());
  SurfaceLine line;
  line.closed = is_closed;
  for (const int v : joined) {
    line.points.push_back(at(v));
    line.vertices.push_back({v, v});
  }
  return line;
}

std::optional<LinePull> PullToStroke(const std::vector<SurfaceLine>& lines, const CanvasPoints& stroke, double reach) {
  CheckStroke(stroke);
  std::optional<LinePull> pull;
  for (const SurfaceLine& line : lines)
    for (const MatchedPart& part : MatchedParts(line, stroke))
      if (part.farthest <= reach && (!pull || part.distance < pull->distance)) pull = PullOf(line, part);
  return pull;
}

}  // namespace daumier::sketch
