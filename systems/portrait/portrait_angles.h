#pragma once
#include <Eigen/Core>

#include <array>
#include <span>

namespace daumier::portrait {

/// Pitch, yaw, roll (radians) of a face that looks in one picture as a face of `angles` in another, each seen by a camera
/// with the focal length 1015 px: a face away from the middle is seen from its side. from, to: where the faces are, pixels
/// from the middle of their pictures, y down; rotation: of the second picture against the first, clockwise, radians.
///   R' = A(to)^T Rz(-rotation) A(from) R,  A(o) = Ry(atan(o_x / 1015)) Rx(atan(o_y / 1015)).
/// Swapping `from` and `to` with the opposite rotation undoes it. @throws Error if there are fewer than three angles.
std::array<float, 3> MovedAngles(std::span<const float> angles, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 double rotation);

/// Where landmarks (68 x 2) have their mean, from the middle of a square picture of that side.
Eigen::Vector2d OffsetOf(std::span<const float> landmarks, double side);

}  // namespace daumier::portrait
