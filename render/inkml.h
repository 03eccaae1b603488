#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <string_view>

namespace daumier::render {

/// Whether bytes are XML whose outermost element is <ink>, with a name space prefix or without.
bool IsInkMl(std::string_view bytes);

/// The traces of an InkML file [W3C 2011] as strokes, y down, shifted so that the sheet is their bounding box. Traces are
/// read in groups of any depth, and those of definitions are not. Channels come in the order of their <traceFormat> (X Y
/// where there is none); all but X and Y are ignored, and so is the resolution. Values may be explicit (!) or coded as
/// first (') or second (") differences, and * repeats the last one. Traces with the pen up, of a brush in white, of an
/// eraser, and of a highlighter (rasterOp maskPen, or more than half transparent) are left out; a warning counts the
/// last. All strokes are of kind 0.
/// @throws Error naming the file and the cause: not XML, truncated, no InkML, a trace that is malformed or not finite,
/// no X or Y, no strokes.
Drawing ReadInkMl(const std::filesystem::path& path);

}  // namespace daumier::render
