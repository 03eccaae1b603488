#pragma once
#include "render/drawing.h"
#include "render/image.h"

namespace daumier::render {

/// A picture of a drawing on the way to its strokes. The pictures of the stages are grey, dark lines on light, and
/// kLineDrawingSide long on their longer side.
struct LineDrawing {
  Image flattened;  ///< On even, white paper: NormaliseBackground.
  Image ink;        ///< InkMask.
  Image skeleton;   ///< Of the ink whose large areas are hollowed out: HollowAreas, Thin.
  Drawing drawing;  ///< In pixels of the picture.
};

/// Every picture is brought to this size first, so that the strokes do not depend on the resolution of a scan.
inline constexpr int kLineDrawingSide = 512;

/// The strokes of a scanned, photographed or exported drawing: dark lines on light or light lines on dark, of any pen.
/// Areas much thicker than the pen are read as their outlines. All strokes are of kind 0.
/// @throws Error if the picture is empty or holds no lines.
LineDrawing TraceLineDrawing(const Image& picture);

}  // namespace daumier::render
