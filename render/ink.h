#pragma once
#include "render/image.h"

namespace daumier::render {

/// Masks are H x W grey pictures of two values: kInk where there is ink, kPaper elsewhere.
inline constexpr uint8_t kInk = 0, kPaper = 255;

/// Where there is ink in a picture from NormaliseBackground whose longer side has some hundred pixels. The threshold is
/// Otsu's [Otsu 1979], lowered for faint lines but kept above the grain of the paper; what is only faintly dark counts
/// as ink where it hangs together with what is darker. Straight lines and dark strips along the picture's border (the
/// edge of a scan, a frame), faint small pieces, and specks smaller than a dot of the pen are paper, and holes of that
/// size are ink. All paper if there are no lines.
Image InkMask(const Image& flattened);

/// The width in pixels of the pen that drew most of the lines: twice the median distance to the paper along the middle
/// of the ink. 0 if there is no ink.
double PenWidth(const Image& ink);

/// Areas much thicker than the pen become their outlines, as wide as the pen, inside the area; lines are unchanged.
/// A gap between areas that is narrower than the pen closes first, and so do small holes in an area with all in them.
/// Where an area is cut by the border of the picture it has no outline.
Image HollowAreas(const Image& ink, double pen_width);

}  // namespace daumier::render
