#pragma once
#include "core/random.h"

#include <span>

namespace daumier::portrait {

/// A picture without a face, 3 x size x size of 0..1: a ground (one colour, a gradient, cloudy noise of several scales,
/// stripes or checks), and on most of them up to 40 discs, rings, rectangles, bars and rows of dots in any colours. Things
/// that resemble parts of faces (pairs of discs, arcs) are among them.
void DrawClutter(std::span<float> picture, int size, Rng& rng);

/// The picture with its blocks exchanged at random, so that parts of a face are there, but in wrong places. A block's side
/// is a quarter of the picture's; a block may be mirrored upside down.
void ShuffleBlocks(std::span<float> picture, int size, Rng& rng);

}  // namespace daumier::portrait
