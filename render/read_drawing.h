#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::render {

/// The drawings of a file by its suffix, in capitals or not: .svg and .svgz (ReadSvg, one), .ndjson (ReadQuickDraw, one
/// a line), anything else as a picture (ReadImage, TraceLineDrawing, one). kind_names as in ReadSvg.
/// @throws Error naming the file and the cause, as these do.
std::vector<Drawing> ReadDrawings(const std::filesystem::path& path, const std::vector<std::string>& kind_names = {});

}  // namespace daumier::render
