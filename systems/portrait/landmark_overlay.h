#pragma once
#include "render/image.h"
#include "systems/portrait/landmark_crop.h"

#include <span>
#include <vector>

namespace daumier::portrait {

/// A picture enlarged or made smaller so that its longer side has `side` pixels, RGB.
render::Image Fitted(const render::Image& picture, int side);

/// Draws the chains of 68 landmarks (jaw, brows, nose, eyes, lips) as antialiased lines with a dot a landmark, `scale`
/// pixels of `image` to one of theirs. Parts have colours of their own; `width` of a line, pixels. Landmarks that are not
/// finite are left out, with the lines to them.
void DrawLandmarks(render::Image& image, std::span<const float> landmarks, double scale, double width = 1.5);
/// The same in one colour.
void DrawLandmarks(render::Image& image, std::span<const float> landmarks, double scale, double width,
                   const render::Rgb& colour);

/// Draws the four sides of a box.
void DrawBox(render::Image& image, const Box& box, double scale, const render::Rgb& colour);

/// The picture tinted by classes (PictureClass) of a mask of its size; the background is unchanged.
render::Image TintedByClasses(const render::Image& picture, const render::Image& mask);

}  // namespace daumier::portrait
