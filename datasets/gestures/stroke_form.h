#pragma once
#include "datasets/styles/polylines.h"

namespace daumier::datasets {

/// Measures of a stroke by which classes of gestures differ; none depends on its place or size.
struct StrokeForm {
  double length = 0;
  double gap = 0;        ///< Distance of its ends over its length: 1 of a straight line, 0 of a closed one.
  double deviation = 0;  ///< Largest distance from the line through its ends, over their distance.
  double turns = 0;      ///< Full turns of its direction from end to end, clockwise on the screen (y down).
  double direction = 0;  ///< From the first point to the last, radians from the right, clockwise.

  bool is_nearly_straight() const { return gap > 0.85 && deviation < 0.12; }
  bool is_nearly_closed() const { return gap < 0.15 && turns * turns > 0.3 && turns * turns < 2.9; }
};

/// Its direction is that of the stroke smoothed over 1/40 of its length, so that tremor does not count. @throws Error
/// unless it has two points that differ.
StrokeForm FormOf(const Polyline& stroke);

/// Moving average over `window` of the length; the ends stay where they are. Points are resampled to `count`.
Polyline Smoothed(const Polyline& stroke, double window, int count);

/// The stroke may be taken for a gesture by its measures: nearly straight, nearly closed, one to three loops on a slant,
/// or most of it a level shaft with a hook at one end.
bool MayBeGesture(const Polyline& stroke);

}  // namespace daumier::datasets
