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

/// The lines of the areas of a scene, a list for each shape, by StrokesOfAreas: the areas of one colour are its ink, all
/// others are its paper, in the order of painting, since a line is what differs from what surrounds it. Of the colours of
/// a picture in many colours, those of the most shapes count; areas of the others become their outlines. `is_area`: of
/// each shape, whether its area is to be read; `side`: of the sheet, in pixels.
std::vector<std::vector<SvgAreaLine>> LinesOfAreas(const SvgScene& scene, const std::vector<bool>& is_area,
                                                   double side);

}  // namespace daumier::render
