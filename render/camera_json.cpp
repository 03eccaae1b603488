#include "render/camera_json.h"

#include "core/error.h"

#include <vector>

namespace daumier::render {

Json CameraToJson(const Camera& camera) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = camera.camera_from_world;
  Json json = {{"camera_from_world", std::vector<double>(rotation.data(), rotation.data() + 9)},
               {"translation", std::vector<double>(camera.translation.begin(), camera.translation.end())}};
  if (camera.perspective) json["perspective"] = true;
  json[camera.perspective ? "focal_length" : "scale"] = camera.scale;
  json["principal_point"] = std::vector<double>(camera.principal_point.begin(), camera.principal_point.end());
  json["width"] = camera.width;
  json["height"] = camera.height;
  return json;
}

Camera CameraFromJson(const Json& json) {
  const auto numbers = [&](const char* key, size_t count) {
    const auto values = json.at(key).get<std::vector<double>>();
    DAUMIER_CHECK(values.size() == count, "malformed camera: {} has {} numbers, expected {}", key, values.size(),
                  count);
    return values;
  };
  const auto rotation = numbers("camera_from_world", 9), translation = numbers("translation", 3),
             principal_point = numbers("principal_point", 2);
  Camera camera;
  camera.camera_from_world = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
  camera.translation = Eigen::Map<const Eigen::Vector3d>(translation.data());
  camera.principal_point = Eigen::Map<const Eigen::Vector2d>(principal_point.data());
  camera.perspective = json.value("perspective", false);
  const char* const scale = camera.perspective ? "focal_length" : "scale";
  camera.scale = json.at(scale);
  DAUMIER_CHECK(camera.scale > 0, "malformed camera: {} is {}, expected a positive number", scale, camera.scale);
  camera.width = json.at("width");
  camera.height = json.at("height");
  return camera;
}

}  // namespace daumier::render
