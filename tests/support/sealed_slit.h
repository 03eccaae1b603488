#pragma once
#include "geometry/mesh.h"
#include "rig/seam.h"

namespace daumier::testing {

/// Closes a slit with a strip of triangles from edge to edge, as the surface of a scan does.
inline void Seal(const rig::SeamEdges& edges, geometry::TriangleMesh& mesh) {
  size_t u = 0, l = 0;
  while (u + 1 < edges.upper.size() || l + 1 < edges.lower.size()) {
    const bool along_upper = u * edges.lower.size() <= l * edges.upper.size() && u + 1 < edges.upper.size();
    const int next = along_upper ? edges.upper[++u] : edges.lower[++l];
    const int before = along_upper ? edges.upper[u - 1] : edges.lower[l - 1];
    const int across = along_upper ? edges.lower[l] : edges.upper[u];
    if (before == across || next == across) continue;  // At the corners.
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, Eigen::NoChange);
    mesh.triangles.bottomRows(1) << before, next, across;
  }
}

}  // namespace daumier::testing
