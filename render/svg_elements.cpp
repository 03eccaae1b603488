#include "render/svg_elements.h"

#include <algorithm>
#include <iterator>

namespace daumier::render {
namespace {

constexpr std::string_view kShapes[] = {"path", "rect", "line", "circle", "ellipse", "polyline", "polygon"};
constexpr std::string_view kWithoutStrokes[] = {"text",     "tspan", "textPath",      "tref",  "altGlyph",
                                                "flowRoot", "image", "foreignObject", "video", "iframe",
                                                "canvas",   "mesh",  "glyphRun"};
constexpr std::string_view kUnpainted[] = {"defs",          "clipPath",       "mask",       "marker",
                                           "pattern",       "linearGradient", "filter",     "radialGradient",
                                           "meshgradient",  "hatch",          "solidColor", "solidcolor",
                                           "stop",          "style",          "stylesheet", "title",
                                           "desc",          "metadata",       "script",     "handler",
                                           "listener",      "view",           "cursor",     "color-profile",
                                           "font",          "font-face",      "glyph",      "missing-glyph",
                                           "hkern",         "vkern",          "animate",    "animateTransform",
                                           "animateMotion", "animateColor",   "set",        "discard",
                                           "mpath",         "link",           "audio",      "template",
                                           "unknown",       "prefetch"};

template <size_t N>
bool HoldsName(const std::string_view (&names)[N], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace

SvgElement SvgElementOf(std::string_view name) {
  if (name == "g" || name == "a") return SvgElement::kGroup;
  if (name == "switch") return SvgElement::kSwitch;
  if (name == "use") return SvgElement::kUse;
  if (name == "svg") return SvgElement::kViewport;
  if (name == "symbol") return SvgElement::kSymbol;
  if (HoldsName(kShapes, name)) return SvgElement::kShape;
  if (HoldsName(kUnpainted, name)) return SvgElement::kUnpainted;
  return HoldsName(kWithoutStrokes, name) ? SvgElement::kNoStrokes : SvgElement::kUnknown;
}

}  // namespace daumier::render
