#pragma once
#include "geometry/path.h"
#include "rig/face_sides.h"

#include <vector>

namespace daumier::testing {

/// The sides of a template without vertices from which a way of at most a tenth of the slit's width along the surface leads
/// to the other side: around the corners, where the surface continues from side to side.
inline std::vector<rig::FaceSide> SidesApart(const geometry::TriangleMesh& surface, const rig::FaceSlits& slits,
                                             std::vector<rig::FaceSide> sides) {
  constexpr double kCorner = 0.1;
  const auto neighbours = geometry::VertexNeighbours(surface.triangles, int(surface.vertices.rows()));
  const std::vector<rig::FaceSide> all = sides;
  for (int s = 0; s < rig::kNumFaceSlits; ++s) {
    const rig::SeamEdges& edges = slits[size_t(s)];
    if (edges.upper.empty()) continue;
    const double width = (surface.vertices.row(edges.upper.back()) - surface.vertices.row(edges.upper.front())).norm();
    for (const rig::FaceSide side : {rig::UpperSide(rig::FaceSlit(s)), rig::LowerSide(rig::FaceSlit(s))}) {
      std::vector<int> seeds;
      for (size_t v = 0; v < all.size(); ++v)
        if (all[v] == rig::OppositeSide(side)) seeds.push_back(int(v));
      const auto nearest = geometry::FindNearestSeeds(surface.vertices, neighbours, seeds, kCorner * width);
      for (size_t v = 0; v < all.size(); ++v)
        if (all[v] == side && nearest.seeds[v] >= 0) sides[v] = rig::FaceSide::kNone;
    }
  }
  return sides;
}

}  // namespace daumier::testing
