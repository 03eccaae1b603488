#pragma once
#include "render/image.h"

#include <array>
#include <vector>

namespace daumier::render {

/// A polyline on the canvas: x right, y down, in pixels of a square canvas of kSketchCanvas; `kind` indexes a list of
/// line kinds (faces::CurveKinds() for sketches of faces).
struct Stroke {
  int kind = 0;
  std::vector<std::array<float, 2>> points;
};

/// Strokes are kept for a canvas of 256 x 256 [Han et al. 2017] and scaled when they are drawn.
inline constexpr int kSketchCanvas = 256;

struct StrokeStyle {
  double width = 1.5;  ///< Pixels of the 256 canvas.
  bool antialias = true;
};

/// Black strokes on white, size x size, one channel. A pixel whose centre is d away from the nearest line of half-width
/// h (in pixels of the picture) is covered by clamp(h + 1/2 - d, 0, 1), or, without antialiasing, wholly iff d <= h;
/// its value is 255 (1 - coverage), rounded. Lines have round ends; one point alone is a dot. Strokes do not add up
/// where they meet, so that neither their order nor their joints show; what lies outside the canvas is cut off.
/// @throws Error if size or width is not positive or a coordinate is not finite.
Image RasteriseStrokes(const std::vector<Stroke>& strokes, int size, const StrokeStyle& style = {});

}  // namespace daumier::render
