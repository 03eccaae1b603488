#pragma once
#include <filesystem>

namespace daumier::render {

/// Whether a file is an SVG as WriteSvg writes the lines of DrawContours: the root of WriteSvg and, in it, paths of the
/// classes of ContourKinds alone. False for what other programs wrote or saved again, and for files that cannot be read.
bool IsContourDrawing(const std::filesystem::path& file);

}  // namespace daumier::render
