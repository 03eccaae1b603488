#pragma once
#include "geometry/mesh.h"

#include <filesystem>
#include <string_view>

namespace daumier::geometry {

/// Reads positions, UV and polygons of a PLY file [Turk 1994], ASCII or binary of either byte order; thread-safe.
/// Read are `vertex` (x, y, z of any type), `face` (the list vertex_indices or vertex_index) and `tristrips` (one list;
/// -1 ends a strip); all other elements and properties are skipped. UV comes from the list `texcoord` of faces (2
/// numbers a corner, as MeshLab writes it; an empty list is a polygon without UV), else from the vertices: the first of
/// (s, t), (u, v), (texture_u, texture_v), (texture_s, texture_t). Equal UV at one vertex becomes one row. The number
/// of the picture (texnumber) is dropped. Polygons need no manifold. Repeated vertices, positions that are not finite
/// and missing UV: as PolygonCollector. `name` names the bytes in messages, for example a file.
/// @throws Error "name: what is wrong (found X, expected Y)": as ParsePlyHeader and PlyRows, no vertex, a corner that is
/// no vertex, no polygon (a cloud of points).
PolygonMesh ParsePly(std::string_view bytes, std::string_view name);

/// ParsePly of a file. @throws Error also if the file cannot be read.
PolygonMesh ReadPly(const std::filesystem::path& path);

/// Writes a binary little-endian PLY atomically, positions and UV (the list `texcoord` of faces) as 32-bit floats.
/// @throws Error naming file and cause: a corner that is no vertex, a position that is not finite as a 32-bit float,
/// and as CheckUv.
void WritePly(const std::filesystem::path& path, const TriangleMesh& mesh);
void WritePly(const std::filesystem::path& path, const PolygonMesh& mesh);

}  // namespace daumier::geometry
