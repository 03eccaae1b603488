#pragma once
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::cli {

/// The shipped face model that weights need, which lies next to them ("face-ict").
/// @throws Error naming the weights if they need none; as NeededWeights and faces::ReadFaceModelWeights.
faces::FaceModel FaceModelOfWeights(const std::filesystem::path& weights);

}  // namespace daumier::cli
