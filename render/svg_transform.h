#pragma once
#include <Eigen/Geometry>

#include <string_view>

namespace daumier::render {

/// The product of a list of transforms [SVG 1.1, 7.6; CSS Transforms 1]: matrix, translate, scale, rotate, skewX,
/// skewY, translateX, translateY, scaleX, scaleY; lengths in pixels, angles in degrees or with a unit. The last one is
/// applied first. An empty list and `none` are the identity.
/// @throws Error with the position if the list is malformed, unknown or not finite.
Eigen::Affine2d ParseSvgTransform(std::string_view text);

}  // namespace daumier::render
