#pragma once
#include "faces/face_model.h"

#include <filesystem>
#include <string>

namespace daumier::cli {

/// The shipped face model of a source ("ict") next to weights that predict its faces.
/// @throws Error naming the weights and where it was expected; as faces::ReadFaceModelWeights.
faces::FaceModel FaceModelNextTo(const std::filesystem::path& weights, const std::string& source);

}  // namespace daumier::cli
