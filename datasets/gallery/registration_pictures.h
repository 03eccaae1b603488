#pragma once
#include "datasets/build/registered_faces.h"
#include "faces/face_database.h"

#include <filesystem>

namespace daumier::datasets {

/// NAME.jpg for each mesh of a database that BuildRegisteredFaces wrote: from the front and from the side the mesh, the
/// registered template, and the distance of each of its vertices to the mesh in millimetres (grey: no match). Into an
/// existing folder. Inputs that failed have no picture. @throws Error if a mesh of the database is not among the inputs, or
/// a picture cannot be written.
void WriteRegistrationPictures(const faces::FaceDatabase& database, const MeshInputs& inputs,
                               const std::filesystem::path& folder);

/// NAME.obj for each mesh: the registered template, into an existing folder. @throws Error as geometry::WriteObj, or if
/// the database does not hold registered meshes.
void WriteRegisteredMeshes(const faces::FaceDatabase& database, const std::filesystem::path& folder);

}  // namespace daumier::datasets
