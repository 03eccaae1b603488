#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Draws the mouth and says its state. A mouth that is drawn closed has one seam, at which the inner points of both
/// lips are, and neither teeth nor a tongue; one that is open has both edges of the opening.
void DrawMouth(const DrawingContext& drawing);

}  // namespace daumier::datasets
