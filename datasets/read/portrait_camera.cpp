#include "datasets/read/portrait_camera.h"

#include "core/error.h"

#include <Eigen/Geometry>

namespace daumier::datasets {

Eigen::Matrix3d PoseRotation(std::span<const float> pose) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(pose[2], Vector3d::UnitZ()) * AngleAxisd(pose[1], Vector3d::UnitY()) *
          AngleAxisd(pose[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

render::Camera PortraitCamera(const PortraitOptics& optics, std::span<const float> pose) {
  DAUMIER_CHECK(pose.size() == 6, "a pose of {} numbers, expected 6", pose.size());
  const Eigen::Vector3d away(1, -1, -1);
  render::Camera camera;
  camera.camera_from_world = away.asDiagonal() * PoseRotation(pose);
  camera.translation =
      away.cwiseProduct(Eigen::Vector3d(pose[3], pose[4], pose[5])) + Eigen::Vector3d(0, 0, optics.distance);
  camera.perspective = true;
  camera.scale = optics.focal;
  camera.principal_point.setConstant(optics.size / 2.0);
  camera.width = camera.height = optics.size;
  return camera;
}

}  // namespace daumier::datasets
