#pragma once
#include "render/strokes.h"

#include <vector>

namespace daumier::fitting {

/// How far two drawings are from each other, pixels of the canvas.
struct StrokeDistance {
  double drawn_to_projected = 0.0;  ///< Mean distance of the drawn lines' points to the nearest projected line.
  double projected_to_drawn = 0.0;

  double two_way() const { return 0.5 * (drawn_to_projected + projected_to_drawn); }
};

/// Means over the lengths of all lines, taken at points at most a pixel apart (or a
/// 12,000th of the length of more than 12,000 pixels). With trimming, the farthest shares of
/// the drawn and of the projected length do not count: hair has no counterpart among a face's curves, and a forehead
/// that hair covers is not drawn. Points outside of the canvas count like others.
/// @throws Error if one side has no line of positive length or a share is not in [0, 1).
StrokeDistance DistanceBetween(const std::vector<render::Stroke>& drawn, const std::vector<render::Stroke>& projected,
                               double drawn_trim = 0.0, double projected_trim = 0.0);

}  // namespace daumier::fitting
