#pragma once
#include "datasets/styles/polylines.h"

/// Lines that nearly are gestures (datasets/gestures/other_strokes.h has what each is).
namespace daumier::datasets {

Polyline ManyLoops(Rng& rng);
Polyline LevelLoops(Rng& rng);
Polyline MixedLoops(Rng& rng);
Polyline TurnedArrow(Rng& rng);
Polyline DoubleArrow(Rng& rng);
Polyline BrokenArrow(Rng& rng);
Polyline TailedRegion(Rng& rng);

}  // namespace daumier::datasets
