#pragma once
#include "render/image.h"

#include <filesystem>

namespace daumier::render {

/// An SVG file as a picture of about its sheet, RGB on white or its background: areas and strokes in the order of painting
/// with their colours and opacities; clip paths, gradients and what ReadSvg leaves out are not there. For the colours of
/// drawings; lines are ReadSvg's.
/// side: pixels of the longer side. scale: if not null, pixels of the picture to one of the sheet.
/// @throws Error as ReadSvg's document and scene; if the file states no size and has no shapes.
Image PaintSvg(const std::filesystem::path& file, int side = 512, double* scale = nullptr);

}  // namespace daumier::render
