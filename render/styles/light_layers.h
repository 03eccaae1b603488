#pragma once
#include "render/styles/picture_layers.h"

#include <array>

namespace daumier::render {

/// Direction to the main light, unit, camera space: that of b in the least-squares fit shade = a + b . normal over the
/// covered pixels. (-0.5, 0.6, 0.62), the upper left in front, where the shade has no direction (|b| < 0.02); light from
/// behind is turned to the front (z at least 0.2).
std::array<float, 3> MainLight(const PictureLayers& layers);

/// The range of the shade over covered pixels: 5th and 95th percentile of those that are skin, or of all where there
/// are fewer than 30. (0, 1) where nothing is covered.
struct ShadeRange {
  float darkest = 0, lightest = 1;
};
ShadeRange RangeOfShade(const PictureLayers& layers);

/// How far each pixel lies behind the mean depth of its surroundings (covered ones within about 6 units), 0..1, 1 at 1.5 cm
/// [Luft et al. 2006]. 0 where nothing is covered.
Plane Occlusion(const PictureLayers& layers);

/// What the main light does not reach, 0..1: the ray from a pixel to the light is followed for 7 cm through the depth
/// plane, whose surfaces are taken to be 6 cm thick; edges are softened by one unit.
Plane CastShadows(const PictureLayers& layers, const std::array<float, 3>& light);

/// The shade smoothed within what is covered: Blur(shade coverage) / Blur(coverage), deviation in units.
Plane SmoothShade(const PictureLayers& layers, float deviation);

}  // namespace daumier::render
