#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Draws the brows; their ends are at the ends of what is drawn.
void DrawBrows(const DrawingContext& drawing);

}  // namespace daumier::datasets
