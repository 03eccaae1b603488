#pragma once
#include "render/svg_clip.h"
#include "render/svg_color.h"
#include "render/svg_document.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier::render {

/// A shape as it is painted: all coordinates and lengths in pixels of the sheet, all opacities in its colours.
struct SvgShape {
  std::vector<SvgPolyline> polylines;  ///< A closed subpath ends where it begins.
  std::optional<SvgColor> fill, stroke;
  bool is_fill_given = false, is_stroke_given = false;  ///< In the file, be it `none`; else it is the initial value.
  FillRule fill_rule = FillRule::kNonzero;
  double stroke_width = 0.0;
  int kind = 0;
  /// The lines from which the program that wrote the file made the area; empty where it does not say.
  std::vector<std::vector<Eigen::Vector2d>> drawn_lines;
  std::vector<std::shared_ptr<const SvgClip>> clips;  ///< Only what lies in all of them is painted.
};

/// What an SVG paints, in its order.
struct SvgScene {
  std::string file;                  ///< What errors and problems call it.
  double width = 0.0, height = 0.0;  ///< 0 where the file has none.
  std::optional<SvgColor> background;
  std::vector<SvgShape> shapes;
  std::vector<std::string> problems;  ///< What is not drawn as the file has it: a line with its place for each.
};

/// The visible shapes of a document [SVG 1.1; SVG 2]: groups, <a>, <switch>, nested <svg>, <use>, <symbol>, styles,
/// transforms and clip paths are resolved. Curves are flattened to `tolerance` times the sheet's longer side. A shape's
/// kind is the place of the first word of its class, or else of its groups' classes, that kind_names holds; 0 where
/// there is none. Paths are drawn up to their first error; an element with another error is left out, and both are
/// problems, as is what has no strokes: text, pictures, masks, patterns, filters, markers, foreign objects.
/// @throws Error naming the file if the size of the sheet is malformed, a <use> contains itself, or the uses multiply
/// to more than SvgWork allows.
SvgScene ReadSvgScene(const SvgDocument& document, const std::vector<std::string>& kind_names, double tolerance);

}  // namespace daumier::render
