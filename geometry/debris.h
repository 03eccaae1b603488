#pragma once
#include "geometry/mesh.h"

namespace daumier::geometry {

/// A surface without small pieces that lie far away from it, as scans leave them.
struct CleanSurface {
  TriangleMesh mesh;  ///< Without UV. Its vertices are those that its triangles use, in their old order.
  int num_pieces_removed = 0;
};

/// Removes connected pieces whose area is below 1 % of the largest piece's and that are far from all others. Far: the
/// box of the largest piece grows by every piece that it comes within 15 % of its longest side of, until there is none;
/// the others are far. Pieces that are connected by shared vertices alone count as one.
/// @throws Error if there is no triangle.
CleanSurface RemoveDebris(const TriangleMesh& mesh);

}  // namespace daumier::geometry
