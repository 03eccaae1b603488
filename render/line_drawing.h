#pragma once
#include "render/drawing.h"
#include "render/image.h"

namespace daumier::render {

/// A picture of a drawing on the way to its strokes. The pictures of the stages are grey, dark lines on light, and
/// kLineDrawingSide long on their longer side; of a small drawing they hold the part of the picture round it.
struct LineDrawing {
  Image flattened;  ///< On even, white paper: NormaliseBackground.
  Image ink;        ///< InkMask.
  Image skeleton;   ///< Of the ink whose large areas are hollowed out: HollowAreas, Thin.
  Drawing drawing;  ///< In pixels of the picture, or of the rectified sheet.
};

/// Every picture is brought to this size first, so that the strokes do not depend on the resolution of a scan.
inline constexpr int kLineDrawingSide = 512;

/// The strokes of a scanned, photographed or exported drawing: dark lines on light or light lines on dark, of any pen.
/// Of a photograph of a sheet on a desk (FindSheets) the sheet alone is read, its perspective undone (RectifySheet); a
/// drawing that is small in its picture is traced at the resolution of the part that it covers; the lines of ruled
/// paper (WithoutRuling) and soft shading are no strokes. Areas much thicker than the pen are read as their outlines.
/// All strokes are of kind 0. A warning says where a photograph shows a desk (ShowsDesk) but no sheet is found.
/// @throws Error if the picture is empty or holds no lines.
LineDrawing TraceLineDrawing(const Image& picture);

}  // namespace daumier::render
