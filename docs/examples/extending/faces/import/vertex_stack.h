#pragma once
#include "faces/import/given_faces.h"

#include <filesystem>
#include <string>

namespace daumier::faces {

/// A folder with template.obj, of which only the polygons are used, and faces.npy, (N, V, 3) numbers: neutral faces of
/// this topology, each its own person, in cm unless the annotation has another unit.
/// @throws Error as ReadMesh, ParseNpy and ImportGivenFaces, and if the shape of faces.npy is another one.
GivenFaces LoadVertexStack(const std::filesystem::path& folder, const AnnotationFile& annotation,
                           const std::string& licence);

}  // namespace daumier::faces
