#include "rig/face_sides.h"

#include "geometry/path.h"

#include <algorithm>

namespace daumier::rig {

FaceSlits SlitsOf(const FaceContact& contact) {
  FaceSlits slits;
  slits[size_t(FaceSlit::kMouth)] = contact.lips().edges();
  for (const FaceContact::Eye& eye : contact.eyes())
    slits[size_t(eye.side == "Right" ? FaceSlit::kRightEye : FaceSlit::kLeftEye)] = eye.lids.edges();
  return slits;
}

std::vector<FaceSide> SidesOfTemplate(const geometry::TriangleMesh& surface, const FaceSlits& slits) {
  const auto neighbours = geometry::VertexNeighbours(surface.triangles, int(surface.vertices.rows()));
  std::vector<FaceSide> sides(size_t(surface.vertices.rows()), FaceSide::kNone);
  for (int s = 0; s < kNumFaceSlits; ++s) {
    const SeamEdges& edges = slits[size_t(s)];
    if (edges.upper.empty()) continue;
    const double width = (surface.vertices.row(edges.upper.back()) - surface.vertices.row(edges.upper.front())).norm();
    // The corners are seeds, too, and keep what is beyond them.
    std::vector<int> seeds = edges.upper;
    seeds.insert(seeds.end(), edges.lower.begin() + 1, edges.lower.end() - 1);
    const auto nearest = geometry::FindNearestSeeds(surface.vertices, neighbours, seeds, kSideReach * width);
    const int num_upper = int(edges.upper.size());
    for (size_t v = 0; v < sides.size(); ++v) {
      const int seed = nearest.seeds[v];
      if (seed <= 0 || seed == num_upper - 1) continue;
      sides[v] = seed < num_upper ? UpperSide(FaceSlit(s)) : LowerSide(FaceSlit(s));
    }
  }
  return sides;
}

}  // namespace daumier::rig
