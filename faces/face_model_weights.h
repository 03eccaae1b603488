#pragma once
#include "core/json.h"
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// Writes shipped weights of a face model (core/weights_folder.h): the files of WriteFaceModel, a card with the notices
/// of its licence, and the manifest. The folder is written whole or not at all; it replaces earlier weights. Equal
/// models give equal bytes. Returns `details` of the manifest, with `largest_error_mm` of identity and expression
/// shapes as they are read again.
/// @throws Error as AddScaledShapes; UsageError as CheckReplacedFolder.
Json WriteFaceModelWeights(const std::filesystem::path& out_directory, const FaceModel& model);

}  // namespace daumier::faces
