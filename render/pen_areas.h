#pragma once
#include "render/area_pieces.h"

#include <vector>

namespace daumier::render {

/// The strokes of filled areas, a list for each area; those of paper are empty. Pieces of an area that are long and
/// thin (area >= 4 width^2, width <= 6 % of the longer side of the sheet) are lines of a pen: what is left of them under
/// the paper painted later becomes its middle lines, which end where the pen did, by the steps of TraceLineDrawing. So
/// do lines that hang on a thick piece, which is hollowed out first, and small pieces no thicker than 2.4 times the
/// pen. An outline that covers or crosses itself, and that no paper is painted over, is read by the pairs of its sides
/// instead (LineOfSweptOutline), up to 12 % of the side wide. Several short areas that touch are one pen line if
/// together they are long and thin. Instead of the middle
/// lines, drawn_lines are taken where the two agree to within the width. All other pieces, and dots without a middle
/// line half as long as wide, become their outlines unchanged. `side`: of the sheet, in pixels. Time and memory are
/// bounded: areas that would take too many pixels are traced in one picture.
/// @throws Error if a point is not finite or side is not positive.
std::vector<std::vector<Stroke>> StrokesOfAreas(const std::vector<PaintedArea>& areas, double side);

}  // namespace daumier::render
