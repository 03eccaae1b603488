#pragma once
#include "faces/import/given_faces.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace daumier::faces {

/// Positions, polygons and UV of a mesh; thread-safe. PLY is known by its first word or .ply, everything else is read as
/// OBJ. @throws Error as geometry::ParseObj and geometry::ParsePly, and if the file is a folder, a drawing, a mesh in
/// another format or what macOS keeps about a file (._NAME), or if its size or places are beyond 1e-30 .. 1e30, whose
/// squares and products are no numbers. Vertices may be not finite.
geometry::PolygonMesh ReadMesh(const std::filesystem::path& path);

/// Whom a file of a mesh folder shows.
enum class PersonOf {
  kFile,    ///< Every file its own person.
  kFolder,  ///< The files of one folder the same person.
};

/// Any folder of registered .obj and .ply meshes (recursively, in order of name, without IsSystemFile), a neutral face each, in cm unless the
/// annotation has another unit. The template has the UV of the first mesh. `licence` is stored unchanged in the
/// provenance.
/// @throws Error naming the first file that is unreadable or of another topology than the first; if there is no mesh;
/// as ImportGivenFaces.
GivenFaces LoadMeshFolder(const std::filesystem::path& folder, const AnnotationFile& annotation, PersonOf person,
                          const std::string& licence);

/// 3DCaricShop [Qiu et al. 2021]: processedData/tMesh/<Person>/<Caricature>.obj below `folder`, which may also be
/// processedData or tMesh itself. The person is the folder's name. Meshes whose number of vertices is not the most
/// frequent one are skipped; a warning counts them.
/// @throws Error as LoadMeshFolder, and if there is no tMesh.
GivenFaces LoadCaricShop(const std::filesystem::path& folder, const AnnotationFile& annotation);

}  // namespace daumier::faces
