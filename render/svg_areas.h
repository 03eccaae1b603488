#pragma once
#include "render/svg_scene.h"

#include <vector>

namespace daumier::render {

/// A line of a painted area without a stroke.
struct SvgAreaLine {
  SvgPolyline polyline;
  /// Of a middle line the last shape of its colour: shapes of one colour make one line. Absent for an outline.
  std::optional<int> last_of_colour;
};

/// The area that a shape paints with its fill.
FilledArea FilledAreaOf(const SvgShape& shape);

/// Replaces rectangles that are filled without a stroke and clipped by areas inside them by these areas: converters from
/// PDF, and programs that fill pens with gradients, write a line of a pen as such a clip. All other shapes keep their
/// clips.
void CutAreasByClips(SvgScene& scene);

/// What becomes of a shape's area.
enum class AreaReading {
  kNothing,   ///< It has no lines, but may hide others.
  kShade,     ///< Nor has its stroke.
  kOutlines,  ///< Its outlines: that of a sheet or a frame.
  kPen,       ///< Its middle lines where it is long and thin, else its outlines.
};

/// The lines of the areas of a scene, a list for each shape, by StrokesOfAreas: the areas of one colour are its ink, all
/// others are its paper, in the order of painting, since a line is what differs from what surrounds it. Of the colours of
/// a picture in many colours, those of the most shapes count; areas of the others become their outlines. `reading`: of
/// each shape with an area; `side`: of the sheet, in pixels.
std::vector<std::vector<SvgAreaLine>> LinesOfAreas(const SvgScene& scene, const std::vector<AreaReading>& reading,
                                                   double side);

}  // namespace daumier::render
