#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <vector>

namespace daumier::render {

/// Drawings of the Quick, Draw! data set [Ha and Eck 2018], one JSON object a line. "drawing" is a list of strokes:
///   [[x...], [y...]]            of the simplified drawings, on a sheet of 256 x 256
///   [[x...], [y...], [t...]]    of the raw drawings, whose times are ignored
/// A drawing that reaches further has a sheet as large as its reach. Empty lines are skipped, and so,
/// with a warning that names file, line and cause, is a line that is no drawing: not JSON, truncated, another layout, x
/// and y of unequal length, a coordinate that is not finite, no strokes.
/// @throws Error if the file holds no drawing, with the cause of the first line that is none.
std::vector<Drawing> ReadQuickDraw(const std::filesystem::path& path);

}  // namespace daumier::render
