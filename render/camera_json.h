#pragma once
#include "core/json.h"
#include "render/camera.h"

namespace daumier::render {

/// For manifests: camera_from_world (9 numbers, row by row), translation, principal_point, width, height; of an
/// orthographic camera `scale`, of one in perspective `perspective` (true) and `focal_length`, so that a reader that
/// expects orthographic cameras refuses it.
Json CameraToJson(const Camera& camera);
/// Undoes CameraToJson. @throws Error or Json::exception if a number is missing or there are too many, and Error if
/// scale or focal length is not positive.
Camera CameraFromJson(const Json& json);

}  // namespace daumier::render
