#pragma once
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// ICT-FaceKit Light [Li et al. 2020]: 100 identity modes with standard normal coefficients and the expression shapes
/// that move the face. A checkout (or its FaceXModel folder), or a tar archive of it. Of its 26,719 vertices the head's
/// 11,248 come first; the bust is cropped.
/// @throws Error as ForEachFile and ParseObj; if the neutral mesh or an identity mode is missing; if a mesh has another
/// number of vertices.
FaceModel LoadIct(const std::filesystem::path& folder_or_archive);

}  // namespace daumier::faces
