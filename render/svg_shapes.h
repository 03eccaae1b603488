#pragma once
#include "render/svg_style.h"
#include "render/svg_viewport.h"

#include <optional>
#include <pugixml.hpp>
#include <string>

namespace daumier::render {

/// Path data equivalent to an element [SVG 1.1, 9]: path, rect, line, circle, ellipse, polyline, polygon. Empty for one
/// that paints nothing, such as a circle of radius 0; nothing if the element is no shape.
/// @throws Error if a length is malformed.
std::optional<std::string> SvgShapeData(const pugi::xml_node& node, const SvgStyle& style, const SvgUnits& units);

}  // namespace daumier::render
