#pragma once
#include "render/strokes.h"
#include "render/svg_scene.h"

#include <vector>

namespace daumier::render {

/// The lines that a viewer of a scene sees, in its order, in pixels of the sheet: strokes, and the lines of areas, of
/// another colour than what lies below them, where no later shape hides them. What hides is an area, or a stroke of the
/// colour of the area below it (an eraser). The sheet is white, or has the scene's background; where nothing but light
/// strokes is on a white sheet, it is dark. No lines are: areas that cover the sheet; a rectangle with all other lines
/// inside, its corners rounded or not, as one line or four (the sheet, or its frame); what lies wholly outside the
/// sheet while other lines lie inside. What is left out for the last two reasons is added to the scene's problems,
/// except frames as large as the sheet. A line that is seen as a whole keeps its points exactly.
/// @throws Error naming the file if an area has more than kMostPointsOfArea points, of which pairs are compared.
std::vector<Stroke> InkOfScene(SvgScene& scene);
inline constexpr size_t kMostPointsOfArea = 30'000;

}  // namespace daumier::render
