#pragma once
#include "geometry/mesh.h"

namespace daumier::geometry {

/// @throws Error unless the mesh has no UV, or every corner has a row of `uv` that exists and is finite.
void CheckUv(const TriangleMesh& mesh);
void CheckUv(const PolygonMesh& mesh);

/// Removes the rows of `uv` that no corner uses and renumbers the rest in order of their old row.
void RemoveUnusedUv(TriangleMesh& mesh);
void RemoveUnusedUv(PolygonMesh& mesh);

}  // namespace daumier::geometry
