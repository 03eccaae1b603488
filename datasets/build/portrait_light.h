#pragma once
#include "core/random.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace daumier::datasets {

/// Monochrome light as 9 spherical harmonics with the constants of Deep3D's program [Deng et al. 2019]: a unit normal n
/// in camera space (x right, y up, z to the viewer) is lit by
///   sum_k (light_k + 0.8 [k = 0]) H_k(n),
///   H = (0.886227, -1.772454 y, 1.772454 z, -1.772454 x, 2.427032 x y, -2.427032 y z, 0.700624 (3 z^2 - 1),
///        -2.427032 x z, 1.213516 (x^2 - y^2)).
using SphericalLight = std::array<float, 9>;

float LightOn(const SphericalLight& light, const Eigen::Vector3f& normal);

/// A lamp far away: strength is what it gives a surface that faces it.
struct DirectionalLight {
  Eigen::Vector3d direction;  ///< To the lamp, unit length.
  double strength;
};

/// Even light and lamps, each max(0, n . direction) strength up to its second degree [Ramamoorthi & Hanrahan 2001].
SphericalLight ProjectLight(double ambient, const std::vector<DirectionalLight>& lamps);

/// Even light, a key light from in front, and with some probability a fill and a light from behind. A normal to the viewer is lit
/// by 0.72 to 1.08.
SphericalLight DrawLight(Rng& rng);

}  // namespace daumier::datasets
