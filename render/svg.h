#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::render {

/// Strokes on the canvas of kSketchCanvas as an SVG, atomic: a <path> a stroke, its class the name of its kind, black,
/// 1.5 wide, with round ends. ReadSvg with the same names gives the same strokes, every float exact; strokes without
/// points are left out, and a stroke whose points all coincide comes back as one point.
/// @throws Error naming the file if it cannot be written, a kind has no name, a name holds white space, or a coordinate
/// is not finite.
void WriteSvg(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
              const std::vector<std::string>& kind_names);

/// The lines of an SVG [SVG 1.1]: path, polyline, polygon, line, rect, circle and ellipse, under the transforms of
/// their groups, in the pixels of width and height (else those of the viewBox, else as far as the strokes
/// reach). Curves are flattened to a tenth of a pixel of a 256 canvas. A stroke's kind is the place of the first word
/// of its class, or else of its groups' classes, that kind_names holds; 0 where there is none. Shapes are read as their
/// outlines. Left out: what is not shown (display, visibility, opacity, neither fill nor stroke), definitions, white
/// areas without stroke, filled backgrounds as large as the sheet, text, pictures, <use>. Style sheets are not read,
/// but style attributes are.
/// @throws Error naming the file, and where it applies element, line and position: not XML, truncated, not an SVG, path
/// data or transforms that are malformed or not finite, no strokes.
Drawing ReadSvg(const std::filesystem::path& path, const std::vector<std::string>& kind_names = {});

}  // namespace daumier::render
