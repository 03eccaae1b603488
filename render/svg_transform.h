#pragma once
#include <Eigen/Geometry>

#include <string_view>

namespace daumier::render {

/// The product of a list of transforms [SVG 1.1, 7.6]: matrix, translate, scale, rotate, skewX, skewY; angles in
/// degrees. The last one is applied first. An empty list is the identity.
/// @throws Error with the position if the list is malformed, unknown or not finite.
Eigen::Affine2d ParseSvgTransform(std::string_view text);

}  // namespace daumier::render
