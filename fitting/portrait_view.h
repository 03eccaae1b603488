#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::fitting {

/// pitch, yaw, roll (radians), t_x, t_y, t_z (cm).
using PortraitPose = Eigen::Matrix<double, 6, 1>;
/// N x 2, pixels of a picture of 224 x 224: x to the right, y down.
using PicturePoints = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The camera of portraits, as models::PortraitCamera.
struct PortraitView {
  double focal = 1015, centre = 112, distance = 100;
};

/// Rz(roll) Ry(yaw) Rx(pitch).
Eigen::Matrix3d RotationOf(const PortraitPose& pose);
/// The pose of a rotation, at the origin: undoes RotationOf, yaw within a quarter turn.
PortraitPose PoseOfRotation(const Eigen::Matrix3d& rotation);
/// R p + t, N x 3.
geometry::Points Posed(const geometry::Points& points, const PortraitPose& pose);
/// x = c + f X / (d - Z), y = c - f Y / (d - Z) of posed points.
PicturePoints Projected(const geometry::Points& posed, const PortraitView& view = {});

/// The angle of the rotation between two poses, degrees.
double AngleBetween(const PortraitPose& a, const PortraitPose& b);

}  // namespace daumier::fitting
