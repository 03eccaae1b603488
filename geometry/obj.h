#pragma once
#include "geometry/mesh.h"

#include <filesystem>
#include <string_view>

namespace daumier::geometry {

/// Reads positions and polygons of a Wavefront OBJ text: `v x y z` and `f` with corners v, v/vt, v//vn or v/vt/vn;
/// negative indices count back from the last vertex read so far. Texture, normal, group and material lines are passed
/// over. `name` stands for the text in messages, for example a file.
/// @throws Error "name:line: cause" on a malformed, non-finite or cut line (a last line without line end counts as
/// cut), a corner that is no vertex or comes twice in its polygon, and if there is no vertex or no polygon at all.
PolygonMesh ParseObj(std::string_view text, std::string_view name);

/// ParseObj of a file. @throws Error also if the file cannot be read.
PolygonMesh ReadObj(const std::filesystem::path& path);

/// Only the positions of an OBJ text whose topology is known already; polygon lines are not looked at.
/// @throws Error "name:line: cause" on a malformed, non-finite or cut vertex line, or if there are not `expected_count`
/// vertices.
Points ParseObjVertices(std::string_view text, std::string_view name, int expected_count);

/// Writes atomically, each number in the shortest form that reads back the same. @throws Error naming file and cause.
void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace daumier::geometry
