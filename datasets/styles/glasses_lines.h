#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Glasses of faces that are no profiles, with both eyes. They hide nothing.
void DrawGlasses(const DrawingContext& drawing);

}  // namespace daumier::datasets
