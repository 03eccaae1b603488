#pragma once
#include "datasets/styles/polylines.h"

namespace daumier::datasets {

/// A line of a drawn face that is no gesture: the side of a nose, an ear, half an eye, lips, a curl or a fringe, a
/// chin with hair, shoulders; mirrored or not, upright but for some degrees.
Polyline DrawingStroke(Rng& rng);

}  // namespace daumier::datasets
