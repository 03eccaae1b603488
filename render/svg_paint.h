#pragma once
#include "render/svg_document.h"
#include "render/svg_style.h"

#include <functional>
#include <optional>
#include <string>

namespace daumier::render {

/// The colour that fill or stroke of a style paints with, its alpha being that of the colour times fill-opacity or
/// stroke-opacity; nothing for `none`. currentColor is replaced; a gradient is the mean of its stops, a pattern medium
/// grey; a reference that leads nowhere is its fallback, or none.
/// `report` receives a line for what is only approximated or leads nowhere.
std::optional<SvgColor> SvgPaint(const SvgDocument& document, const SvgStyle& style, SvgProperty paint,
                                 const std::function<void(const std::string&)>& report);

}  // namespace daumier::render
