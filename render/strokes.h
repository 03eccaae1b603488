#pragma once
#include "render/image.h"

#include <array>
#include <vector>

namespace daumier::render {

/// A polyline on the canvas: x right, y down, in pixels of a square canvas of kSketchCanvas; `kind` indexes a list of line kinds
/// (faces::CurveKinds() for sketches of faces).
struct Stroke {
  int kind = 0;
  std::vector<std::array<float, 2>> points;
};

/// Strokes are kept for a canvas of 256 x 256 [Han et al. 2017] and scaled when they are drawn.
inline constexpr int kSketchCanvas = 256;

struct StrokeStyle {
  double width = 1.5;       ///< Pixels of the 256 canvas.
  bool antialias = true;
};

/// Black strokes on white, size x size, one channel.
Image RasteriseStrokes(const std::vector<Stroke>& strokes, int size, const StrokeStyle& style = {});

}  // namespace daumier::render
