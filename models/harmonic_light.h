#pragma once
#include <torch/types.h>

namespace daumier::models {

/// Left out of the first number of a light: numbers of 0 are light from everywhere, shade 0.886227 * 0.8 = 0.709.
inline constexpr double kAmbientLight = 0.8;

/// Shade (B, V) of normals (B, V, 3), turned to the viewer's frame, under monochrome light (B, 9) of spherical harmonics
/// [Ramamoorthi and Hanrahan 2001] with the constants of [Deng et al. 2019]:
///   sum_k (l_k + 0.8 [k = 0]) c_k h_k,  c h = (0.886227, -1.772454 y, 1.772454 z, -1.772454 x, 2.427032 xy,
///   -2.427032 yz, 0.700624 (3 z^2 - 1), -2.427032 xz, 1.213516 (x^2 - y^2)).
/// @throws daumier::Error if a shape differs.
torch::Tensor HarmonicShade(const torch::Tensor& normals, const torch::Tensor& light);

}  // namespace daumier::models
