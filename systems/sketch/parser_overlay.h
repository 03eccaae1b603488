#pragma once
#include "render/image.h"
#include "systems/sketch/drawing_parser.h"

#include <vector>

namespace daumier::sketch {

/// The strokes of a parsed drawing in pieces of one label each, which is their kind; a piece ends where the next begins.
std::vector<render::Stroke> LabelRuns(const ParsedDrawing& drawing);

/// The lines of a parsed drawing on the canvas in the colours of their labels (faces::ColourOf), and its points as
/// dots, the surer the stronger; side x side, RGB.
render::Image ParsedPicture(const ParsedDrawing& drawing, const render::Placement& canvas_from_sheet, int side);

}  // namespace daumier::sketch
