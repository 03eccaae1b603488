#pragma once
#include "geometry/mesh.h"

#include <filesystem>

namespace daumier::geometry {

/// Reads positions and polygons of a PLY file, ASCII or binary, through OpenMesh.
/// @throws Error naming file and cause: unreadable, no vertex, fewer vertices or polygons than its header says,
/// non-finite positions, or polygons that are no manifold surface.
PolygonMesh ReadPly(const std::filesystem::path& path);

/// Writes a binary little-endian PLY atomically, positions as 32-bit floats.
/// @throws Error naming file and cause, or as CheckManifold.
void WritePly(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace daumier::geometry
