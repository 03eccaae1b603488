#pragma once
#include "render/styles/colour_planes.h"

#include <array>

namespace daumier::render {

/// A shape of one colour with edges that are one pixel soft. Lengths in pixels; what lies outside is cut off.
struct ShapePaint {
  std::array<float, 3> colour;
  float alpha = 1;
};

/// An ellipse: half axes along x and y before it is turned by `angle` (radians, from x towards y).
void FillEllipse(ColourPlanes& colours, float x, float y, float half_x, float half_y, float angle,
                 const ShapePaint& paint);
/// A box with rounded corners: half sides, turned by `angle`.
void FillBox(ColourPlanes& colours, float x, float y, float half_x, float half_y, float angle, float corner,
             const ShapePaint& paint);
/// All below a curve: `top` has a height (row) for each column.
void FillBelow(ColourPlanes& colours, const std::vector<float>& top, const ShapePaint& paint);

}  // namespace daumier::render
