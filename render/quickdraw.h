#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <vector>

namespace daumier::render {

/// Drawings of the Quick, Draw! data set [Ha and Eck 2018], one JSON object a line: "drawing" is a list of strokes,
/// each
/// [[x...], [y...]] or [[x...], [y...], [t...]], whose times are left out. The sheet of the simplified drawings is
/// 256 x 256; a raw drawing that reaches further has one as large as its reach. Empty lines are skipped.
/// @throws Error naming file and line: not JSON, truncated, another layout, x and y of unequal length, a coordinate
/// that is not finite, no strokes; and if the file holds no drawing.
std::vector<Drawing> ReadQuickDraw(const std::filesystem::path& path);

}  // namespace daumier::render
