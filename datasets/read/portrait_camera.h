#pragma once
#include "render/camera.h"

#include <span>

namespace daumier::datasets {

/// The camera of portraits, that of Deep3D's faces [Deng et al. 2019].
struct PortraitOptics {
  int size = 224;         ///< Pixels a side.
  double focal = 1015;    ///< Pixels.
  double distance = 100;  ///< From the viewer to the origin of posed faces, cm.
};

/// R = Rz(roll) Ry(yaw) Rx(pitch), radians. `pose`: pitch, yaw, roll, and more that is ignored.
Eigen::Matrix3d PoseRotation(std::span<const float> pose);

/// The camera that sees a vertex p (cm) of a face of that pose (pitch, yaw, roll, t_x, t_y, t_z) at
///   q = R p + t, x = size / 2 + focal q_x / (distance - q_z), y = size / 2 - focal q_y / (distance - q_z).
/// @throws Error unless the pose has 6 numbers.
render::Camera PortraitCamera(const PortraitOptics& optics, std::span<const float> pose);

}  // namespace daumier::datasets
