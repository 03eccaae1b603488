#pragma once
#include "render/styles/colour_planes.h"

namespace daumier::render {

/// Ink of a round nib at (x, y), pixels: each pixel whose centre is d away gets at least clamp(h + 1/2 - d, 0, 1), where
/// h = half_width. Stamps do not add up. Half-widths below 1/2 give faint hairlines: coverage at most h + 1/2, and none
/// below -1/2. What lies outside the plane is cut off.
void StampInk(Plane& ink, float x, float y, float half_width);

}  // namespace daumier::render
