#pragma once
#include "render/image.h"

namespace daumier::render {

/// The picture without the lines of ruled or squared paper: straight lines from border to border, at most 15 degrees
/// from a side of the picture, of which five or more are parallel at one distance or its multiples; with them lines
/// across them, such as a margin; and single lines of another colour than the drawing's. Where a line of the page is
/// alone the paper takes its place; what is clearly darker there, or has ink on both sides, is the drawing's.
/// A picture without such lines is unchanged. Its longer side has some hundred pixels; lines are darker than paper.
Image WithoutRuling(const Image& picture);

}  // namespace daumier::render
