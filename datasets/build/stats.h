#pragma once
#include "core/json.h"
#include "faces/face_database.h"

#include <filesystem>
#include <span>
#include <vector>

namespace daumier::datasets {

/// How many principal components explain a share of the variance of some faces of a database: the least k such that the
/// k largest eigenvalues of their centred Gram matrix sum to `share` of its trace. 0 if the faces do not differ.
int NumPrincipalComponents(const faces::FaceDatabase& database, std::span<const int> faces, double share);

/// At most `count` faces of a database, ascending, drawn without replacement and always the same: every k-th face would
/// show but some of the expressions.
std::vector<int> SampleFaces(const faces::FaceDatabase& database, int count);

/// The statistics of a folder of faces that `daumier dataset stats` prints: counts, source and licences, gammas,
/// expressions, millimetres_per_cm, data hash, and principal_components_99: {identities (neutral faces of level 1),
/// faces (SampleFaces, at most 1,500), num_faces}.
/// @throws Error as faces::FaceDatabase.
Json FaceStatistics(const std::filesystem::path& directory);

}  // namespace daumier::datasets
