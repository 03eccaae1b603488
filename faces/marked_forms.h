#pragma once
#include "faces/marked_points.h"

#include <optional>
#include <string>
#include <string_view>

namespace daumier::faces {

/// The rows of an array as NumPy, PyTorch or Python print it, or of rows in brackets: [[1. 2. 3.]\n [4. 5. 6.]],
/// array([[1., 2.], ...]), [1, 2, 3] a line, (1, 2, 3). Innermost brackets become rows, those of one list a number a
/// row. Nothing where the text is something else, JSON among it.
std::optional<std::string> RowsOfPrintedArray(std::string_view text);

/// The rows of the one specimen of a TPS file [Rohlf 2015] (LM=68 or LM3=68, then the points); ID, IMAGE, SCALE, CURVES
/// and the rest are left out, and SCALE is not applied. Lines keep their numbers. Nothing where the text does not begin
/// with LM. @throws Error naming file and line: fewer or more rows than stated, or several specimens.
std::optional<std::string> RowsOfTps(std::string_view text, const std::string& name);

/// The vertices of a PLY file, ASCII or binary, as points; those that are not finite are absent. @throws Error as
/// geometry::ParsePlyHeader and PlyRows, more than 1,000 vertices (a mesh, not its landmarks), or no x, y, z.
MarkedPoints ParseMarkedPly(std::string_view bytes, const std::filesystem::path& path);

}  // namespace daumier::faces
