#pragma once
#include "render/svg_areas.h"
#include "render/svg_scene.h"

#include <vector>

namespace daumier::render {

/// Whether a shape is a rectangle over nearly the whole sheet, rounded or not.
bool CoversSheet(const SvgScene& scene, const SvgShape& shape);

/// Removes strokes that only make an area wider: of nearly the colour of a fill that the file gives, no wider than the
/// area is thick, or hairlines of exactly its colour, around closed subpaths. Tracers and whiteboards write them. An
/// open curve, and a fill that is the initial value, are of a file that leaves out fill='none': there the stroke is the
/// line.
void JoinStrokesWithAreas(SvgScene& scene);

/// What becomes of the areas of a scene on a sheet of colour `paper` and size `side`, in pixels. No lines have:
/// - areas that cover the sheet, and those with a stroke, which is their line;
/// - areas of the colour of the ground, which is the paper or the last large rectangle below: holes of the ink. They
///   are ink only on an area that remains thick despite all its holes: a dark ground;
/// - washes: areas that differ from the ground less than half as much as what is seen inside them or along most of their
///   outline, or that are of the same colour with less opacity;
/// - shades of an edge: areas less than half as thick as darker ink along most of their outline, with their hairlines.
/// Large rectangles are read as outlines, all others as drawn by a pen. Linear in the points of the scene, but for a
/// limited number of pairs of shapes, beyond which areas are read as drawn by a pen.
std::vector<AreaReading> ReadingOfAreas(const SvgScene& scene, const SvgColor& paper, double side);

}  // namespace daumier::render
