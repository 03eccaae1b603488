#pragma once
#include "datasets/build/faces.h"
#include "faces/import/given_faces.h"

#include <filesystem>

namespace daumier::datasets {

/// Writes a faces::FaceDatabase of registered meshes, used unmodified, a person an identity. Level g of person p in
/// expression e is
///   LevelMaker(p neutral)_g + (p in e - p neutral);
/// with gamma 0 alone nothing is exaggerated, and the annotation needs landmarks only. The number of persons and their
/// expressions are given, not drawn; details.names and details.groups identify each person.
/// @throws Error as BuildShards and given.face, and naming the region that exaggeration lacks; UsageError on an unknown
/// expression, if neutral or gamma 0 is not first, or if faces are to be interpolated.
void BuildGivenFaces(const faces::GivenFaces& given, const FacesOptions& options,
                     const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::datasets
