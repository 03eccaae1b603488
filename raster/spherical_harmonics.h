#pragma once
#include <array>
#include <cstdint>

namespace daumier::raster {

/// Numbers of a light of one colour: spherical harmonics up to degree 2.
inline constexpr int kLightBands = 9;
/// Added to the first number: a light of zeros shades everything with 0.8 * 0.886227.
inline constexpr double kAmbientLight = 0.8;

/// shade(n) = sum_k (light_k + 0.8 [k = 0]) phi_k(n) with the functions of Deep3D [Deng et al. 2019], for a unit normal
/// (x right, y up, z to the viewer):
///   phi = [0.886227, -1.772454 y, 1.772454 z, -1.772454 x, 2.427032 x y, -2.427032 y z, 0.700624 (3 z^2 - 1),
///          -2.427032 x z, 1.213516 (x^2 - y^2)].
/// normals: num_normals x 3; shades: num_normals, written. Not clamped: a shade may be negative.
template <class T>
void Shade(const std::array<T, kLightBands>& light, int64_t num_normals, const T* normals, T* shades);

/// Adds the gradient of sum(shades * shade_gradient) to light_gradient and to normal_gradient (num_normals x 3).
template <class T>
void ShadeBackward(const std::array<T, kLightBands>& light, int64_t num_normals, const T* normals,
                   const T* shade_gradient, std::array<T, kLightBands>& light_gradient, T* normal_gradient);

}  // namespace daumier::raster
