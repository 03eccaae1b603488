#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Draws the nose; its bottom and wings are shown where the style has them: not by nostrils or a bridge alone. In a
/// profile the outline is the nose's, and the wing and the nostril alone are drawn here.
void DrawNose(const DrawingContext& drawing);

}  // namespace daumier::datasets
