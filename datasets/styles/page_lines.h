#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Hatched shade of cheeks, nose, lips or neck.
void DrawHatching(const DrawingContext& drawing);
/// The cross, the lines of eyes and mouth and the circle that help to construct a face.
void DrawConstruction(const DrawingContext& drawing);
/// Frames, writing and specks around what is there.
void DrawPageMarks(const DrawingContext& drawing);

}  // namespace daumier::datasets
