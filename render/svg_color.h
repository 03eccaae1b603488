#pragma once
#include <Eigen/Core>

#include <optional>
#include <string_view>

namespace daumier::render {

/// An sRGB colour; all parts in [0, 1].
struct SvgColor {
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
  double alpha = 1.0;
};

/// A colour by any notation of [CSS Color 4] for sRGB: #rgb, #rgba, #rrggbb, #rrggbbaa, rgb() and rgba(), hsl() and
/// hsla(), hwb() with commas or spaces, color(srgb ...) and color(display-p3 ...), whose values are taken as sRGB's,
/// the 148 names and `transparent`. Names and functions in capitals or not; parts out of range are clamped; what
/// follows a function or #-notation after white space is ignored (SVG 1.1's icc-color). Nothing if it is none of them.
std::optional<SvgColor> ParseSvgColor(std::string_view text);

}  // namespace daumier::render
