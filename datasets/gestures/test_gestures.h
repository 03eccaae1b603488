#pragma once
#include "core/random.h"
#include "datasets/gestures/gesture.h"
#include "datasets/styles/polylines.h"

/// Strokes that test a recogniser of gestures. Their shapes and hands are independent of any strokes that train it.
namespace daumier::datasets {

/// One stroke of a class as a hurried person draws it, in pixels of a sheet, y down, 40 to 600 across except for dots
/// and short hooks of kNone. Each call is another person with another device: a plan of points (`test_plans.h`), a
/// movement of the hand (`pen_motion.h`), and its samples (`pen_device.h`). At least two points, all of them finite.
Polyline DrawTestGesture(Gesture gesture, Rng& rng);

}  // namespace daumier::datasets
