#pragma once
#include <string>
#include <string_view>

namespace daumier::render {

/// Refuses files that hold drawings or pictures in formats that are not read: HEIC, AVIF, JPEG XL, GIF, PDF, PostScript,
/// Photoshop, Illustrator, Figma, Sketch, Procreate, Krita, Excalidraw, office documents, meshes and others. They are recognised
/// by their content, whatever their name is.
/// @throws Error that names the file, the format, and how to export an SVG or PNG from it.
void RefuseForeignFormat(std::string_view bytes, const std::string& name);

}  // namespace daumier::render
