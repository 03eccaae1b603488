#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// A cap, a brimmed hat, a beanie, a top hat or a cone over what is there: lines behind it are removed. Not in
/// profiles.
void DrawHat(const DrawingContext& drawing);

}  // namespace daumier::datasets
