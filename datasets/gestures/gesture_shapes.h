#pragma once
#include "datasets/gestures/gesture.h"
#include "datasets/styles/polylines.h"

/// Gestures as lines of a size of about 1, before a hand draws them, y down, drawn in either direction.
namespace daumier::datasets {

/// A gesture as its class defines it, all else drawn at random. @throws Error if it is kNone.
Polyline DrawGestureShape(Gesture gesture, Rng& rng);

/// Its parts, of which near misses are made too.

/// A shaft from (0, 0) to (1, 0), a little bent.
Polyline DrawShaft(Rng& rng);
/// A shaft with a hook at its end: a barb, two barbs, or a closed head; begun at either end.
Polyline DrawArrow(Rng& rng);
/// A path with loops along x, all of one sense, each a turn, with or without a way before and behind them.
Polyline DrawLoops(int num_loops, Rng& rng);

/// Angles of what is level enough for a shaft and of the slant of a roll, degrees.
inline constexpr double kShaftTilt = 28, kLeastSlant = 15, kGreatestSlant = 73;

}  // namespace daumier::datasets
