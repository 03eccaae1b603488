#pragma once

namespace daumier::faces {

/// A group of neighbouring numbers of a vector.
struct CoefficientSlot {
  int first, count;
};

/// The coefficients x of a portrait [Pan et al. 2024, section 3.1.2], 239 numbers in this order. A model with fewer
/// modes than a slot has numbers leaves the last numbers unused; they are 0.
///   identity    standard normal
///   expression  weights in 0 .. 1, or standard normal (ExpressionWeights)
///   albedo      standard normal
///   light       monochrome spherical harmonics of bands 0, 1 and 2; of the first number 0.8 are left out
///   pose        pitch, yaw, roll (radians), t_x, t_y, t_z (cm): p_view = Rz(roll) Ry(yaw) Rx(pitch) p + t
inline constexpr CoefficientSlot kIdentitySlot{0, 80}, kExpressionSlot{80, 64}, kAlbedoSlot{144, 80},
    kLightSlot{224, 9}, kPoseSlot{233, 6};
inline constexpr int kNumCoefficients = 239;

}  // namespace daumier::faces
