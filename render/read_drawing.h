#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::render {

/// The drawings of a file by its content: SVG (ReadSvg, one), Quick, Draw! (ReadQuickDraw, one a line), Xournal++
/// (ReadXournal, one), InkML (ReadInkMl, one), anything else as a picture (ReadImage, TraceLineDrawing, one). Where the
/// content does not show it, the suffix says which, in capitals or not. kind_names as in ReadSvg.
/// @throws Error naming the file and the cause, as these do; of other formats what it is and how to export a drawing
/// from it (RefuseForeignFormat).
std::vector<Drawing> ReadDrawings(const std::filesystem::path& path, const std::vector<std::string>& kind_names = {});

}  // namespace daumier::render
