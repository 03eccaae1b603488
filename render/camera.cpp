#include "render/camera.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::render {

Frame FrameOf(const geometry::Points& points, double margin) {
  DAUMIER_CHECK(points.rows() > 0, "a frame needs at least one point");
  DAUMIER_CHECK(points.allFinite(), "the points of a frame are not finite");
  const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  return {.centre = 0.5 * (low + high).transpose(), .half_height = 0.5 * margin * (high - low).maxCoeff()};
}

Camera TurnedCamera(const Eigen::Vector3d& centre, double half_height_cm, int size, double yaw_degrees,
                    double pitch_degrees) {
  DAUMIER_CHECK(half_height_cm > 0.0 && size > 0, "a camera of {} pixels for {} cm, expected positive numbers", size,
                half_height_cm);
  const double yaw = yaw_degrees * std::numbers::pi / 180.0, pitch = pitch_degrees * std::numbers::pi / 180.0;
  const Eigen::Vector3d right(std::cos(yaw), 0.0, -std::sin(yaw));
  const Eigen::Vector3d away(-std::sin(yaw) * std::cos(pitch), -std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
  Camera camera;
  camera.camera_from_world << right.transpose(), away.cross(right).transpose(), away.transpose();
  camera.translation = -camera.camera_from_world * centre;
  camera.scale = 0.5 * size / half_height_cm;
  camera.principal_point.setConstant(0.5 * size);
  camera.width = camera.height = size;
  return camera;
}

Camera FrontalCamera(const Eigen::Vector3d& centre, double half_height_cm, int size) {
  return TurnedCamera(centre, half_height_cm, size, 0.0);
}

Camera SideCamera(const Eigen::Vector3d& centre, double half_height_cm, int size) {
  return TurnedCamera(centre, half_height_cm, size, -90.0);
}

Camera WithPerspective(const Camera& camera, double distance_cm) {
  DAUMIER_CHECK(!camera.perspective, "the camera is in perspective already");
  DAUMIER_CHECK(distance_cm > 0.0, "a camera at a distance of {} cm, expected a positive one", distance_cm);
  Camera result = camera;
  result.perspective = true;
  result.scale *= distance_cm;
  result.translation.z() += distance_cm;
  return result;
}

Camera Enlarged(const Camera& camera, int factor) {
  DAUMIER_CHECK(factor > 0, "a camera enlarged {} times, expected a positive factor", factor);
  Camera result = camera;
  result.scale *= factor;
  result.principal_point *= factor;
  result.width *= factor;
  result.height *= factor;
  return result;
}

geometry::Points Project(const Camera& camera, const geometry::Points& points) {
  geometry::Points result = (points * camera.camera_from_world.transpose()).rowwise() + camera.translation.transpose();
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const double factor = camera.perspective ? camera.scale / result(i, 2) : camera.scale;
    result(i, 0) = result(i, 0) * factor + camera.principal_point.x();
    result(i, 1) = result(i, 1) * factor + camera.principal_point.y();
  }
  return result;
}

}  // namespace daumier::render
