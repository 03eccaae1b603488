#pragma once
#include "geometry/mesh.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::geometry {

/// Reads positions, UV and polygons of a Wavefront OBJ text: `v x y z`, `vt u [v]` and `f` with corners v, v/vt, v//vn
/// or v/vt/vn, where an empty or zero vt or vn is absent; negative indices count back from the last line read so far.
/// Lines as ObjLines; the last may lack its line end. What follows the position of a vertex (a weight, a colour) and
/// lines of normals, groups and materials are skipped; so are points, lines and free-form elements, which a warning
/// counts. Repeated vertices, positions that are not finite and missing UV: as PolygonCollector. vt of corners is ignored
/// in a text without `vt` lines. `name` names the text in messages, for example a file.
/// @throws Error "name:line: cause" on a malformed line or a corner that is no vertex, and "name: cause" as
/// PolygonCollector and if there is no vertex or no polygon at all (a cloud of points).
PolygonMesh ParseObj(std::string_view text, std::string_view name);

/// ParseObj of a file. @throws Error also if the file cannot be read.
PolygonMesh ReadObj(const std::filesystem::path& path);

/// Only the positions of an OBJ text of known topology; polygon lines are skipped.
/// @throws Error "name:line: cause" on a malformed vertex line or a position that is not finite, or if there are not
/// `expected_count` vertices.
Points ParseObjVertices(std::string_view text, std::string_view name, int expected_count);

/// Writes atomically, each number in the shortest form that reads back the same; UV as `vt` lines and corners v/vt.
/// @throws Error naming file and cause, and as CheckUv.
void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh);
void WriteObj(const std::filesystem::path& path, const PolygonMesh& mesh);

/// A material of an MTL file: a diffuse colour in linear light and the strength of a sharp highlight, both from 0 to 1.
struct ObjMaterial {
  std::string name;
  std::array<float, 3> diffuse = {};
  float specular = 0;
};
/// A run of triangles in a written OBJ file: its `g` and `usemtl`.
struct ObjPart {
  std::string group, material;
  Eigen::Index num_triangles = 0;
};

/// Writes a mesh whose triangles are the runs `parts`, smoothly shaded (`s 1`), and its materials into a file of the same
/// name with the extension .mtl. Each atomically, the materials first. @throws Error as WriteObj, or if the runs do not
/// add up to the triangles.
void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<ObjPart>& parts,
              const std::vector<ObjMaterial>& materials);

}  // namespace daumier::geometry
