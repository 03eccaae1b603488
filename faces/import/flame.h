#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// FLAME [Li et al. 2017] as an .npz of plain arrays: v_template (V, 3) in metres, f, shapedirs (V, 3, S), whose first
/// 300 are identity and the rest expression. The joints are not read: the jaw stays closed.
/// @throws Error naming file and array, as ReadNpz; UsageError with the conversion command for a .pkl.
FaceModel LoadFlame(const std::filesystem::path& file, const AnnotationFile& annotation);

}  // namespace daumier::faces
