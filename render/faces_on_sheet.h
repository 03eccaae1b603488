#pragma once
#include "render/drawing.h"

#include <vector>

namespace daumier::render {

/// The drawings of several faces on one sheet, from left to right and, where their columns overlap, from top to bottom;
/// the drawing alone where it does not clearly hold several. Groups are strokes whose bounding boxes are nearer to each
/// other than an eighth of the longer side of the larger box, joined until no two are. Groups are faces if each has at
/// least four strokes (kFewestStrokes), half the size and a third of the line length of the largest, is neither wider
/// nor higher than 2.5 times its other side, and together they have 85 % of the length of all lines: so that hair,
/// ears, eyes and shoulders of one face stay with it. What else is on the sheet belongs to the nearest face. Each
/// drawing has the sheet of the whole.
std::vector<Drawing> FacesOnSheet(const Drawing& drawing);

/// Of drawings as FacesOnSheet returns them, the one whose strokes' bounding box is largest.
/// @throws Error if there is none.
const Drawing& LargestFace(const std::vector<Drawing>& faces);

}  // namespace daumier::render
