#pragma once
#include "core/random.h"
#include "render/styles/colour_planes.h"

namespace daumier::render {

/// Generalised Kuwahara filter with eight overlapping windows around each pixel [Papari et al. 2007]: the mean of window
/// means, weighted by 1 / (variance + e)^2. Smooths inside of forms and keeps their borders. Radius in pixels; 0 copies.
ColourPlanes Kuwahara(const ColourPlanes& picture, int radius);

/// Unit directions along the forms, perpendicular to the smoothed structure tensor's main direction of a plane.
struct FlowField {
  Plane x, y;
  Plane strength;  ///< Anisotropy, 0 (none) to 1.
};
FlowField FlowAlongForms(const Plane& plane, float deviation);

/// An oil painting of a picture: a ground by Kuwahara, on it two layers of short strokes along the forms, coarse ones
/// first, that keep to what has nearly their colour [after Hertzmann 1998]; the ridges of bristles catch light from the
/// upper left. `brush`: width of the fine strokes, pixels.
ColourPlanes BrushPainting(const ColourPlanes& picture, float brush, Rng& rng);

}  // namespace daumier::render
