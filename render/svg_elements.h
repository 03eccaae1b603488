#pragma once
#include <string_view>

namespace daumier::render {

/// What the reader of drawings does with an element of SVG.
enum class SvgElement {
  kGroup,      ///< <g>, <a>: its children are drawn.
  kSwitch,     ///< The first child whose conditions hold is drawn.
  kUse,        ///< The element that it refers to is drawn.
  kViewport,   ///< <svg>: its children are drawn in a coordinate system of their own.
  kSymbol,     ///< The same, where a <use> refers to it.
  kShape,      ///< It has strokes and areas of its own.
  kUnpainted,  ///< Definitions, metadata, animations: it paints nothing in its own place.
  kNoStrokes,  ///< Text, pictures, foreign objects: it paints what has no strokes.
  kUnknown     ///< No element of SVG; it and its children are not drawn [SVG 2, 5.2].
};

/// The kind of an element by its name without prefix.
SvgElement SvgElementOf(std::string_view name);

}  // namespace daumier::render
