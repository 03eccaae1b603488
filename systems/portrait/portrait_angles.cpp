#include "systems/portrait/portrait_angles.h"

#include "core/error.h"
#include "fitting/portrait_view.h"

#include <Eigen/Geometry>

#include <cmath>

namespace daumier::portrait {
namespace {

/// How a face at this offset is turned from the line of sight of one in the middle.
Eigen::Matrix3d TurnedAside(const Eigen::Vector2d& offset) {
  const double focal = fitting::PortraitView().focal;
  return (Eigen::AngleAxisd(std::atan(offset.x() / focal), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(std::atan(offset.y() / focal), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

std::array<float, 3> MovedAngles(std::span<const float> angles, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 double rotation) {
  DAUMIER_CHECK(angles.size() >= 3, "{} angles, expected pitch, yaw and roll", angles.size());
  fitting::PortraitPose pose = fitting::PortraitPose::Zero();
  pose.head<3>() << angles[0], angles[1], angles[2];
  const Eigen::Matrix3d moved = TurnedAside(to).transpose() *
                                Eigen::AngleAxisd(-rotation, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                                TurnedAside(from) * fitting::RotationOf(pose);
  const fitting::PortraitPose result = fitting::PoseOfRotation(moved);
  return {float(result[0]), float(result[1]), float(result[2])};
}

Eigen::Vector2d OffsetOf(std::span<const float> landmarks, double side) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (size_t n = 0; n + 1 < landmarks.size(); n += 2) sum += Eigen::Vector2d(landmarks[n], landmarks[n + 1]);
  return sum / (double(landmarks.size()) / 2) - Eigen::Vector2d::Constant(side / 2);
}

}  // namespace daumier::portrait
