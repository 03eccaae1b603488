#pragma once
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// Drawn strokes in black and, over them, curves in red, both on the canvas: size x size, RGB.
/// @throws Error as RasteriseStrokes.
Image DrawnWithCurves(const std::vector<Stroke>& drawn, const std::vector<Stroke>& curves, int size);

}  // namespace daumier::render
