#pragma once
#include "render/strokes.h"

#include <vector>

namespace daumier::render {

/// Strokes that show on the canvas what the given ones show, few enough to be drawn and measured hundreds of times.
/// `scale`: pixels of the canvas of one unit of the strokes. Drawings of at most 10,000 points and 12,000 px of lines
/// are returned unchanged. Of others, points nearer than a pixel to the last one and pieces that cover nothing new are
/// left out: where earlier pieces of about the same direction (to 45 degrees) run through the same cells. Cells are
/// 1 px wide, or twice to eight times that where more than 20,000 pieces are left.
/// @throws Error if the scale is not positive or a coordinate is not finite.
std::vector<Stroke> SparseStrokes(const std::vector<Stroke>& strokes, double scale);

}  // namespace daumier::render
