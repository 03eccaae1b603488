#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// FaceScape's bilinear model v1.6 [Yang et al. 2020], .npz: shape_bm_core (3V, 52, 50), id_mean, id_var (50),
/// fv_indices counted from 1. The core is linearised at the mean identity:
///   mean = C_0 id_mean, identity k = C_0k sqrt(id_var_k), expression e = (C_e - C_0) id_mean,
/// with C_e the (3V, 50) slice of expression e. A unit counts as a millimetre unless the annotation has another unit.
/// @throws Error naming file and array, as ReadNpz.
FaceModel LoadFaceScape(const std::filesystem::path& file, const AnnotationFile& annotation);

}  // namespace daumier::faces
