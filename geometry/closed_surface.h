#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// Whether each edge has two triangles, which run along it in opposite directions.
bool IsClosed(const Triangles& triangles);

/// Volume of closed surfaces wound outwards, by the divergence theorem: sum_f p_0 . (p_1 x p_2) / 6, cm^3.
double EnclosedVolume(const TriangleMesh& mesh);

/// A surface of which at most two triangles meet at an edge, and one fan at a vertex.
struct ManifoldSurface {
  TriangleMesh mesh;      ///< Without UV; triangles in their old order, vertices in use alone.
  int num_bad_edges = 0;  ///< Edges of more than two triangles, or of two that run along it in the same direction.
};

/// The surface cut open along bad edges, and at vertices where several fans of triangles meet: each fan has a vertex of its
/// own. @throws Error if a triangle has a vertex twice, or one that is not there.
ManifoldSurface CutToManifold(const TriangleMesh& mesh);

/// Closes a hole (as BoundaryLoops gives it) by triangles from its edges to a new vertex in the middle of its corners.
void FillHole(const std::vector<int>& loop, TriangleMesh& mesh);

/// The connected parts of a surface, in the order of their lowest vertex.
std::vector<TriangleMesh> ConnectedParts(const TriangleMesh& mesh);

/// Surfaces as one mesh, without UV.
TriangleMesh Joined(const std::vector<TriangleMesh>& parts);

}  // namespace daumier::geometry
