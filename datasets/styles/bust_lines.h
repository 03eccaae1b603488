#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Neck, shoulders and collar, behind the head.
void DrawBust(const DrawingContext& drawing);
/// Earrings below the ears that are drawn.
void DrawEarrings(const DrawingContext& drawing);

}  // namespace daumier::datasets
