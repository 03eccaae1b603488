#pragma once
#include "render/drawing.h"

#include <vector>

namespace daumier::render {

/// The drawings of several faces on one sheet, from left to right and, where their columns overlap, from top to bottom;
/// the drawing alone where it does not clearly hold several. Groups are strokes whose bounding boxes are nearer to each
/// other than an eighth of the longer side of the larger box, joined until no two are. Groups are faces if each has at
/// least four strokes (kFewestStrokes), half the size (two fifths if it and the largest have an outline with more than
/// three further strokes) and a third of the line length of the largest, is neither wider
/// nor higher than 2.5 times its other side, and together they have 85 % of the length of all lines: so that hair,
/// ears, eyes and shoulders of one face stay with it. What else is on the sheet belongs to the nearest face. Each
/// drawing has the sheet of the whole. Titles, dates and signatures are left out: rows of at least four strokes smaller
/// than a fifth of the faces, or a stroke below that turns up and down as writing does, which are an eighth of the
/// faces' size below or a quarter above all else, if heads with an outline, or one group as large as all others together, have most of the other lines.
std::vector<Drawing> FacesOnSheet(const Drawing& drawing);

/// The number of strokes of a drawing, with points, that are in none of its faces as FacesOnSheet returns them.
size_t NumLeftOut(const Drawing& drawing, const std::vector<Drawing>& faces);

/// Of drawings as FacesOnSheet returns them, the one whose strokes' bounding box is largest.
/// @throws Error if there is none.
const Drawing& LargestFace(const std::vector<Drawing>& faces);

}  // namespace daumier::render
