#pragma once
#include "core/random.h"
#include "render/styles/picture_layers.h"
#include "render/styles/style_choice.h"

#include <vector>

namespace daumier::render {

/// A point of an ink line found in the buffers, in pixels of the picture.
struct LinePoint {
  float x, y;
  float strength;  ///< 0..1: the outline of the head 1, faint creases near 0.
};

/// Borders between neighbouring samples: of coverage (1), of things (PicturePart, classes of skin), of steps of depth that
/// the slope of the surface does not explain, and of eye colours. Each point is moved to the weighted mean of its
/// neighbours within two samples, which takes the steps of the raster out of lines.
std::vector<LinePoint> BorderLines(const PictureBuffers& buffers);

/// Valleys of n . v on skin and hair: lines of an artist where the surface turns away and back, as folds and wings of the
/// nose [DeCarlo et al. 2003, image-space algorithm]. Points where the plane, smoothed by 1.2 units, is least across its
/// largest second derivative.
std::vector<LinePoint> ValleyLines(const PictureLayers& layers);

/// Coverage by ink in 0..1 of the lines that the choice names. @throws Error if a stroke's point is not finite.
Plane DrawPictureLines(const PictureBuffers& buffers, const PictureLayers& layers, const StyleChoice& choice, Rng& rng);

/// The picture under ink of the choice's colour, or a dark shade of what is there (line_tint).
void InkOver(ColourPlanes& colours, const Plane& ink, const StyleChoice& choice);

}  // namespace daumier::render
