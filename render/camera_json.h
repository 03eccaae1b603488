#pragma once
#include "core/json.h"
#include "render/camera.h"

namespace daumier::render {

/// For manifests: camera_from_world (9 numbers, row by row), translation, scale, principal_point, width, height.
/// @throws Error for a camera in perspective, which no manifest holds.
Json CameraToJson(const Camera& camera);
/// Undoes CameraToJson. @throws Error or Json::exception if a number is missing or there are too many.
Camera CameraFromJson(const Json& json);

}  // namespace daumier::render
