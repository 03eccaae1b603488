#pragma once
#include <array>
#include <cstdint>

namespace daumier::raster {

/// (pitch, yaw, roll) in radians about x, y, z, then a translation in cm.
template <class T>
using Pose = std::array<T, 6>;

/// R = Rz(roll) Ry(yaw) Rx(pitch), row-major.
template <class T>
std::array<T, 9> RotationOf(const Pose<T>& pose);

/// posed = R p + t. points, posed: num_points x 3; they may be the same memory.
template <class T>
void ApplyPose(const Pose<T>& pose, int64_t num_points, const T* points, T* posed);

/// Adds the gradient of sum(posed * posed_gradient) to pose_gradient (6) and, unless it is null, to point_gradient
/// (num_points x 3).
template <class T>
void ApplyPoseBackward(const Pose<T>& pose, int64_t num_points, const T* points, const T* posed_gradient,
                       Pose<T>& pose_gradient, T* point_gradient);

/// Adds to pose_gradient's angles the gradient of sum(R * rotation_gradient).
template <class T>
void RotationBackward(const Pose<T>& pose, const std::array<T, 9>& rotation_gradient, Pose<T>& pose_gradient);

}  // namespace daumier::raster
