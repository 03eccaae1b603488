#pragma once
#include "render/image.h"

namespace daumier::render {

/// The skeleton of a mask (render/ink.h): lines of one pixel in the middle of the ink [Guo and Hall 1989]. It has as
/// many 8-connected pieces of ink and as many 4-connected pieces of paper as the mask, and lies inside the ink. No
/// pixel can be taken from it without changing that or shortening a line. Beyond the picture is paper.
/// @throws Error if the mask has more than one channel.
Image Thin(const Image& ink);

}  // namespace daumier::render
