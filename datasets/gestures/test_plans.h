#pragma once
#include "datasets/gestures/pen_motion.h"

/// What a person aims at who draws one of the ten gestures: points in pixels around the origin, y down. Each call is
/// another person, with habits of size, slant and roundness. Angles are in degrees, counter-clockwise from the right.
namespace daumier::datasets {

/// Moved to the middle of its box and scaled to the larger side of it.
PenPlan FittedPlan(PenPlan plan, double extent_px);
/// Turned about the origin, counter-clockwise on the sheet.
PenPlan TurnedPlan(PenPlan plan, double degrees);
/// Uniform in its logarithm: small and large numbers are equally frequent.
double DrawLogUniform(double low, double high, Rng& rng);

PenPlan PlanTestLine(Rng& rng);
/// Around an area: ellipses, squares, beans, drops and lumps; its ends leave a gap, meet, overlap or cross.
PenPlan PlanTestRegion(Rng& rng);
/// A shaft whose head lies in a direction, and a head of one or two barbs; drawn from either end.
PenPlan PlanTestArrow(double direction_degrees, Rng& rng);
/// A way to the right with loops; the ends lie exactly on a line that rises by the angle.
/// @throws Error if there are no loops.
PenPlan PlanTestRoll(int num_loops, double rise_degrees, Rng& rng);

}  // namespace daumier::datasets
