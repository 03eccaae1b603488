#include "fitting/portrait_view.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::fitting {

Eigen::Matrix3d RotationOf(const PortraitPose& pose) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(pose[2], Vector3d::UnitZ()) * AngleAxisd(pose[1], Vector3d::UnitY()) *
          AngleAxisd(pose[0], Vector3d::UnitX()))
      .toRotationMatrix();
}

PortraitPose PoseOfRotation(const Eigen::Matrix3d& rotation) {
  PortraitPose pose = PortraitPose::Zero();
  pose[0] = std::atan2(rotation(2, 1), rotation(2, 2));
  pose[1] = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
  pose[2] = std::atan2(rotation(1, 0), rotation(0, 0));
  return pose;
}

geometry::Points Posed(const geometry::Points& points, const PortraitPose& pose) {
  geometry::Points posed = points * RotationOf(pose).transpose();
  posed.rowwise() += pose.tail<3>().transpose();
  return posed;
}

PicturePoints Projected(const geometry::Points& posed, const PortraitView& view) {
  PicturePoints pixels(posed.rows(), 2);
  for (Eigen::Index i = 0; i < posed.rows(); ++i) {
    const double scale = view.focal / (view.distance - posed(i, 2));
    pixels.row(i) << view.centre + scale * posed(i, 0), view.centre - scale * posed(i, 1);
  }
  return pixels;
}

double AngleBetween(const PortraitPose& a, const PortraitPose& b) {
  const double trace = (RotationOf(a).transpose() * RotationOf(b)).trace();
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace daumier::fitting
