#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Draws the eyes and says their states. Both are drawn in one style. A closed eye is one line, at which its top and
/// its bottom are. A dot or a dash has a centre alone, and no state.
void DrawEyes(const DrawingContext& drawing);

}  // namespace daumier::datasets
