#include "rig/lid_edges.h"

#include "core/error.h"
#include "faces/openings.h"
#include "geometry/topology.h"

#include <algorithm>
#include <limits>

namespace daumier::rig {
namespace {

constexpr int kNumRings = 5;

/// The vertices at `ring` edges from a hole, as a loop around it; empty if they are none.
std::vector<int> RingAround(const faces::FaceTemplate& face_template, const std::vector<int>& rings, int ring) {
  std::vector<int> rows;
  for (int f = 0; f < face_template.triangles.rows(); ++f) {
    const auto corners = face_template.triangles.row(f);
    if (std::ranges::all_of(corners, [&](int v) { return rings[size_t(v)] >= ring; })) rows.push_back(f);
  }
  const geometry::Triangles triangles = face_template.triangles(rows, Eigen::all);
  try {
    for (std::vector<int>& loop : geometry::BoundaryLoops(triangles, face_template.num_vertices()))
      if (std::ranges::all_of(loop, [&](int v) { return rings[size_t(v)] == ring; })) return std::move(loop);
  } catch (const Error&) {  // Without that ring the mesh falls apart: it is no loop.
  }
  return {};
}

double MeanHeightOf(const geometry::Points& points, const std::vector<int>& path) {
  double sum = 0;
  for (const int v : path) sum += points(v, 1);
  return sum / double(path.size());
}

}  // namespace

SeamEdges FindLidEdges(const faces::FaceTemplate& face_template, const std::vector<int>& hole,
                       const geometry::Points& closed) {
  DAUMIER_CHECK(hole.size() >= 4, "an opening between lids has {} vertices, expected 4 or more", hole.size());
  const std::vector<int> rings =
      geometry::RingsFrom(geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices()), hole);
  SeamEdges best;
  double least = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring <= kNumRings; ++ring) {
    const std::vector<int> loop = ring == 0 ? hole : RingAround(face_template, rings, ring);
    if (loop.size() < 4) break;
    const faces::Opening opening = faces::DivideLoop(face_template.neutral, loop);
    const double height = std::abs(MeanHeightOf(closed, opening.upper) - MeanHeightOf(closed, opening.lower));
    if (height >= least) continue;
    least = height;
    best = {opening.upper, opening.lower};
  }
  return best;
}

}  // namespace daumier::rig
