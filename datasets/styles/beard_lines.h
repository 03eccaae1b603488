#pragma once
#include "datasets/styles/drawing_context.h"

namespace daumier::datasets {

/// Beards, moustaches and stubble. A beard with a border hides the jaw and the chin; others hide nothing. Nothing in a
/// profile or without a mouth; beards with a border on frontal faces alone.
void DrawBeard(const DrawingContext& drawing);

}  // namespace daumier::datasets
