#pragma once
#include "core/random.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// A stroke bent and stretched by itself [Yu et al. 2016]: handles are its ends and points at equal arc lengths between
/// them; one of them stays, each other moves by shift_px * straightness * (r1 |N|, r2 |N|) with N standard normal and
/// the signs r1, r2 one for the stroke; its points follow by moving least squares of similarities. straightness is the
/// chord over the length: straighter strokes move more. Of a closed stroke it is that of its halves, and it stays
/// closed. Strokes of fewer than three points, or of no length, are unchanged.
render::Stroke DeformStroke(render::Stroke stroke, double shift_px, Rng& rng);

/// All strokes together [Yu et al. 2016]: the leftmost, rightmost, topmost and bottommost points move by shift_px N
/// along each axis, all points follow by moving least squares of rigid motions. A move that changes which of two of
/// these points is further left, or further up, is drawn again, ten times at most in all; then the point stays.
std::vector<render::Stroke> DeformDrawing(std::vector<render::Stroke> strokes, double shift_px, Rng& rng);

}  // namespace daumier::datasets
